// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/geometry/pose3.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <random>

namespace slam6d {
namespace {

using std::numbers::pi;

Eigen::Vector3d Draw(std::mt19937& random, double scale) {
  std::uniform_real_distribution<double> coordinate(-scale, scale);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return {x, y, coordinate(random)};
}

Pose3 DrawPose(std::mt19937& random) {
  return {.rotation = RotationFromVector(Draw(random, 1.7)), .translation_m = Draw(random, 100.0)};
}

double NormOfDifference(const Pose3& a, const Pose3& b) {
  return (a.rotation - b.rotation).norm() + (a.translation_m - b.translation_m).norm();
}

TEST(Pose3, MapsPointsFromChildToParent) {
  const Pose3 T_map_robot{.rotation = RotationFromRollPitchYaw({0.0, 0.0, pi / 2.0}),
                          .translation_m = {1.0, 2.0, 3.0}};
  const Eigen::Vector3d p_map = T_map_robot * Eigen::Vector3d(3.0, 0.0, 1.0);
  EXPECT_NEAR((p_map - Eigen::Vector3d(1.0, 5.0, 4.0)).norm(), 0.0, 1e-12);
}

TEST(Pose3, ObeysTheGroupLaws) {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Pose3 a = DrawPose(random);
    const Pose3 b = DrawPose(random);
    const Pose3 c = DrawPose(random);
    EXPECT_NEAR(NormOfDifference(a * a.Inverse(), Pose3{}), 0.0, 1e-12);
    EXPECT_NEAR(NormOfDifference((a * b) * c, a * (b * c)), 0.0, 1e-11);
    EXPECT_NEAR(NormOfDifference((a * b).Inverse(), b.Inverse() * a.Inverse()), 0.0, 1e-11);
  }
}

TEST(Pose3, ABlockRotationTurnsTranslationAndRotationAlike) {
  std::mt19937 random(9);
  const Pose3 pose = DrawPose(random);
  const Eigen::Vector3d v = Draw(random, 1.0);
  const Eigen::Vector3d w = Draw(random, 1.0);
  Vector6d both;
  both << v, w;
  const Vector6d turned = BlockRotation(pose.rotation) * both;
  EXPECT_NEAR((turned.head<3>() - pose.rotation * v).norm(), 0.0, 1e-15);
  EXPECT_NEAR((turned.tail<3>() - pose.rotation * w).norm(), 0.0, 1e-15);
}

TEST(Pose3, PitchIsNoseDown) {
  const Eigen::Matrix3d R = RotationFromRollPitchYaw({0.0, 0.1, 0.0});
  EXPECT_LT((R * Eigen::Vector3d::UnitX()).z(), 0.0);
}

TEST(Pose3, RotationVectorsAndAnglesAreInverseToTheirRotations) {
  std::mt19937 random(8);
  for (const double scale : {0.0, 1e-9, 1e-3, 1.0}) {
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d v = Draw(random, scale);
      EXPECT_NEAR((RotationVector(RotationFromVector(v)) - v).norm(), 0.0, 1e-14 + 1e-9 * scale);
      EXPECT_NEAR(RotationAngle(RotationFromVector(v)), v.norm(), 1e-9 * scale);
      const Eigen::Vector3d angles = Draw(random, scale);
      const Eigen::Vector3d back = RollPitchYaw(RotationFromRollPitchYaw(angles));
      EXPECT_NEAR((back - angles).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Pose3, RollPitchYawOfGimbalLockGivesTheSameRotation) {
  const Eigen::Matrix3d R = RotationFromRollPitchYaw({0.3, pi / 2.0, 0.8});
  EXPECT_NEAR((RotationFromRollPitchYaw(RollPitchYaw(R)) - R).norm(), 0.0, 1e-7);
}

TEST(Pose3, NearestRotationIsARotationAndLeavesRotationsAlone) {
  std::mt19937 random(9);
  const Eigen::Matrix3d R = RotationFromVector(Draw(random, 1.0));
  EXPECT_NEAR((NearestRotation(R) - R).norm(), 0.0, 1e-14);
  const Eigen::Matrix3d repaired = NearestRotation(1.01 * R + 0.01 * Eigen::Matrix3d::Ones());
  EXPECT_NEAR((repaired * repaired.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(repaired.determinant(), 1.0, 1e-14);
}

TEST(Pose3, ScaledMotionsAddUp) {
  std::mt19937 random(10);
  const Pose3 motion = DrawPose(random);
  const Pose3 half = ScaledMotion(motion, 0.5);
  EXPECT_NEAR((half.rotation * half.rotation - motion.rotation).norm(), 0.0, 1e-12);
  EXPECT_NEAR((2.0 * half.translation_m - motion.translation_m).norm(), 0.0, 1e-12);
}

TEST(Pose3, QuaternionsCarryARotationAndBringItBackToTheLastBit) {
  std::mt19937 random(11);
  for (int i = 0; i < 100'000; ++i) {
    const Eigen::Matrix3d measured = RotationFromVector(Draw(random, i % 2 == 0 ? 3.0 : 1e-6));
    const Eigen::Matrix3d carried = RotationFromQuaternion(QuaternionOf(measured));
    ASSERT_LT(RotationAngle(measured.transpose() * carried), 2e-13) << "case " << i;
    ASSERT_EQ(RotationFromQuaternion(QuaternionOf(carried)), carried) << "case " << i;
    ASSERT_EQ(RotationFromQuaternion(-3.0 * QuaternionOf(carried)), carried) << "case " << i;
  }
  for (const double angle_rad : {0.0, 0.5 * pi, pi}) {
    const Eigen::Matrix3d R =
        RotationFromQuaternion(QuaternionOf(RotationFromRollPitchYaw({0.0, 0.0, angle_rad})));
    EXPECT_EQ(RotationFromQuaternion(QuaternionOf(R)), R) << angle_rad;
  }
  EXPECT_FALSE(RotationFromQuaternion(Eigen::Vector4d::Zero()).allFinite());
}

TEST(Pose3, ComposedCovariancePredictsTheSpread) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  const auto draw_spread = [&] {
    Matrix6d A;
    for (double& a : A.reshaped()) a = 0.01 * normal(random);
    return Matrix6d(A * A.transpose());
  };
  const UncertainPose3 a_b{DrawPose(random), draw_spread()};
  const UncertainPose3 b_c{{RotationFromVector(Draw(random, 1.0)), {2.0, -1.0, 0.5}},
                           draw_spread()};
  const auto disturb = [&](const UncertainPose3& pose) {
    Vector6d e;
    for (double& x : e) x = normal(random);
    e = pose.covariance.llt().matrixL() * e;
    return Pose3{RotationFromVector(e.tail<3>()) * pose.T_a_b.rotation,
                 pose.T_a_b.translation_m + e.head<3>()};
  };
  const UncertainPose3 a_c = a_b * b_c;
  Matrix6d spread = Matrix6d::Zero();
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const Pose3 drawn = disturb(a_b) * disturb(b_c);
    const Vector6d e = Difference(drawn, a_c.T_a_b);
    spread += e * e.transpose() / kDraws;
  }
  EXPECT_LT((spread - a_c.covariance).norm(), 0.05 * a_c.covariance.norm());
}

}  // namespace
}  // namespace slam6d
