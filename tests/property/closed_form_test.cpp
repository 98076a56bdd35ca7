// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/icp/closed_form.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <vector>

namespace slam6d {
namespace {

struct Pairs {
  std::vector<Eigen::Vector3d> ref;
  std::vector<Eigen::Vector3d> cur;
};

PairMoments MomentsOf(const Pairs& pairs) {
  PairMoments moments{.count = static_cast<double>(pairs.ref.size())};
  for (std::size_t i = 0; i < pairs.ref.size(); ++i) {
    moments.center_ref_m += pairs.ref[i] / moments.count;
    moments.center_cur_m += pairs.cur[i] / moments.count;
  }
  for (std::size_t i = 0; i < pairs.ref.size(); ++i) {
    moments.H_m2 +=
        (pairs.cur[i] - moments.center_cur_m) * (pairs.ref[i] - moments.center_ref_m).transpose();
  }
  return moments;
}

double Cost(const Pairs& pairs, const Pose3& T_ref_cur) {
  double cost = 0.0;
  for (std::size_t i = 0; i < pairs.ref.size(); ++i) {
    cost += (pairs.ref[i] - T_ref_cur * pairs.cur[i]).squaredNorm();
  }
  return cost;
}

Eigen::Vector3d Draw(std::mt19937& random, double scale_m) {
  std::normal_distribution<double> coordinate_m(0.0, scale_m);
  const double x = coordinate_m(random);
  const double y = coordinate_m(random);
  return {x, y, coordinate_m(random)};
}

Pose3 DrawPose(std::mt19937& random) {
  return {.rotation = RotationFromVector(Draw(random, 1.0)), .translation_m = Draw(random, 20.0)};
}

/// Points of a room, or of a plane, seen from two poses with noise.
Pairs DrawPairs(const Pose3& T_ref_cur, bool flat, double noise_m, std::mt19937& random) {
  Pairs pairs;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = Draw(random, 5.0);
    pairs.cur.push_back({p.x(), p.y(), flat ? 0.0 : p.z()});
    pairs.ref.push_back(T_ref_cur * pairs.cur.back() + Draw(random, noise_m));
  }
  return pairs;
}

TEST(ClosedForms, AgreeWithTheSvdToANanometre) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const Pose3 T_ref_cur = DrawPose(random);
    const PairMoments moments = MomentsOf(DrawPairs(T_ref_cur, seed % 2 == 0, 0.3, random));
    const std::optional<Pose3> expected = AlignPairs(moments, ClosedForm::kSvd);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(expected->rotation.determinant(), 1.0, 1e-12);
    for (const auto& [name, form] : Names(ClosedForm{})) {
      SCOPED_TRACE(name);
      const std::optional<Pose3> T = AlignPairs(moments, form);
      ASSERT_TRUE(T);
      EXPECT_NEAR((T->rotation - expected->rotation).norm(), 0.0, 1e-9);
      EXPECT_NEAR((T->translation_m - expected->translation_m).norm(), 0.0, 1e-9);
    }
  }
}

TEST(ClosedForms, RecoverTheMotionOfPointsWithoutNoise) {
  std::mt19937 random(1);
  const Pose3 T_ref_cur = DrawPose(random);
  const PairMoments moments = MomentsOf(DrawPairs(T_ref_cur, false, 0.0, random));
  for (const auto& [name, form] : Names(ClosedForm{})) {
    SCOPED_TRACE(name);
    const Pose3 T = *AlignPairs(moments, form);
    EXPECT_NEAR((T.rotation - T_ref_cur.rotation).norm(), 0.0, 1e-12);
    EXPECT_NEAR((T.translation_m - T_ref_cur.translation_m).norm(), 0.0, 1e-11);
  }
}

TEST(ClosedForms, AreMinima) {
  std::mt19937 random(2);
  const Pairs pairs = DrawPairs(DrawPose(random), false, 1.0, random);
  for (const auto& [name, form] : Names(ClosedForm{})) {
    SCOPED_TRACE(name);
    const Pose3 T = *AlignPairs(MomentsOf(pairs), form);
    for (int i = 0; i < 50; ++i) {
      const Pose3 nearby{.rotation = RotationFromVector(Draw(random, 1e-3)) * T.rotation,
                         .translation_m = T.translation_m + Draw(random, 1e-3)};
      EXPECT_LT(Cost(pairs, T), Cost(pairs, nearby));
    }
  }
}

TEST(ClosedForms, NeverReflect) {
  // A mirrored cloud: the best orthonormal matrix would be a reflection.
  std::mt19937 random(3);
  Pairs pairs = DrawPairs(Pose3{}, false, 0.0, random);
  for (Eigen::Vector3d& p : pairs.ref) p.z() = -p.z();
  for (const auto& [name, form] : Names(ClosedForm{})) {
    EXPECT_NEAR(AlignPairs(MomentsOf(pairs), form)->rotation.determinant(), 1.0, 1e-12) << name;
  }
}

TEST(ClosedForms, SayThatALineOrTwoPairsLeaveTheRotationOpen) {
  Pairs line;
  for (int i = 0; i < 10; ++i) {
    line.cur.push_back({1.0 * i, 2.0 * i, 0.0});
    line.ref.push_back({1.0 * i, 2.0 * i, 1.0});
  }
  Pairs two{.ref = {{0, 0, 0}, {1, 0, 0}}, .cur = {{0, 0, 0}, {1, 0, 0}}};
  for (const auto& [name, form] : Names(ClosedForm{})) {
    EXPECT_FALSE(AlignPairs(MomentsOf(line), form)) << name;
    EXPECT_FALSE(AlignPairs(MomentsOf(two), form)) << name;
    EXPECT_FALSE(AlignPairs(PairMoments{}, form)) << name;
  }
}

}  // namespace
}  // namespace slam6d
