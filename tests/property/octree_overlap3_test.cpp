// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "slam6d/mapping/octree_overlap.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

double OffM(const Pose3& a, const Pose3& b) {
  return (a.translation_m - b.translation_m).norm();
}

TEST(OctreeOverlap, IsWholeForAScanAndItself) {
  const OverlapOptions options;
  const OverlapModel scan(ScanRoom({}, 5000, 0.0, 1), options);
  const OverlapReference itself{.model = &scan, .T_map_ref = {}};
  EXPECT_EQ(Overlap({&itself, 1}, scan, {}, options), 1.0);
  const Pose3 far{.translation_m = {1e7, 0.0, 0.0}};
  EXPECT_EQ(Overlap({&itself, 1}, scan, far, options), 0.0);
}

TEST(OctreeOverlap, IsTheSameInEveryFrame) {
  const OverlapOptions options;
  const OverlapModel scan(ScanRoom({}, 3000, 0.0, 2), options);
  const OverlapModel other(ScanRoom({}, 3000, 0.01, 3), options);
  const Pose3 T_map_ref{.rotation = RotationFromRollPitchYaw({0.1, 0.2, 2.0}),
                        .translation_m = {100.0, -50.0, 3.0}};
  const OverlapReference here{.model = &scan, .T_map_ref = {}};
  const OverlapReference there{.model = &scan, .T_map_ref = T_map_ref};
  EXPECT_NEAR(Overlap({&here, 1}, other, {}, options),
              Overlap({&there, 1}, other, T_map_ref, options),
              0.01);
}

TEST(OctreeOverlap, BringsAPoorGuessWithinReachOfIcp) {
  const OverlapOptions options;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-1.0, 1.0);
    const Pose3 T_ref_cur{.rotation = RotationFromRollPitchYaw({0.02, 0.01, 0.4}),
                          .translation_m = {0.3, 0.5, 0.1}};
    const OverlapModel ref(ScanRoom({}, 8000, 0.005, 2 * seed), options);
    const OverlapModel cur(ScanRoom(T_ref_cur, 8000, 0.005, 2 * seed + 1), options);
    Pose3 guess = T_ref_cur;
    guess.translation_m += Eigen::Vector3d(0.9 * off(random), 0.9 * off(random), 0.0);
    guess.rotation = RotationFromRollPitchYaw({0.0, 0.0, 0.15 * off(random)}) * guess.rotation;
    const OverlapReference reference{.model = &ref, .T_map_ref = {}};
    const OverlapGuess found = GuessByOverlap({&reference, 1}, cur, guess, options);
    EXPECT_LT(OffM(found.T_map_cur, T_ref_cur), 0.25);
    EXPECT_LT(RotationAngle(found.T_map_cur.rotation.transpose() * T_ref_cur.rotation), 0.06);
    EXPECT_GE(found.overlap, Overlap({&reference, 1}, cur, guess, options));
  }
}

TEST(OctreeOverlap, KeepsAGoodGuess) {
  const OverlapOptions options;
  const OverlapModel ref(ScanRoom({}, 8000, 0.005, 4), options);
  const OverlapModel cur(ScanRoom({}, 8000, 0.005, 5), options);
  const OverlapReference reference{.model = &ref, .T_map_ref = {}};
  const OverlapGuess found = GuessByOverlap({&reference, 1}, cur, {}, options);
  EXPECT_EQ(found.T_map_cur.translation_m, Eigen::Vector3d::Zero());
  EXPECT_GT(found.motions_tried, 100U);
}

TEST(OctreeOverlap, SeeksNoLongerForWhatLiesFarFromItsFrame) {
  const OverlapOptions options;
  const Pose3 far{.translation_m = {400e3, 5e6, 0.0}};
  const OverlapModel ref(far * ScanRoom({}, 3000, 0.005, 4), options);
  const OverlapModel cur(far * ScanRoom({}, 3000, 0.005, 5), options);
  const OverlapReference reference{.model = &ref, .T_map_ref = {}};
  EXPECT_LT(GuessByOverlap({&reference, 1}, cur, {}, options).motions_tried, 100'000U);
}

TEST(OctreeOverlap, KeepsItsStepsWhereAPointIsStray) {
  PointCloud cloud = ScanRoom({}, 3000, 0.005, 4);
  const double radius_m = OverlapModel(cloud, {}).radius_m();
  cloud.push_back({300e3, 0.0, 0.0});
  EXPECT_LT(OverlapModel(cloud, {}).radius_m(), 4.0 * radius_m);
}

TEST(OctreeOverlap, OfNothingIsNone) {
  const OverlapOptions options;
  const OverlapModel empty(PointCloud{}, options);
  const OverlapModel scan(ScanRoom({}, 1000, 0.005, 6), options);
  const OverlapReference reference{.model = &scan, .T_map_ref = {}};
  const OverlapReference nothing{.model = &empty, .T_map_ref = {}};
  EXPECT_EQ(GuessByOverlap({&reference, 1}, empty, {}, options).overlap, 0.0);
  EXPECT_EQ(GuessByOverlap({&nothing, 1}, scan, {}, options).overlap, 0.0);
}

}  // namespace
}  // namespace slam6d
