// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/geometry/pose3.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <random>

namespace slam6d {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Vector3d Draw(std::mt19937& random, double scale) {
  std::uniform_real_distribution<double> coordinate(-scale, scale);
  const double x = coordinate(random);
  const double y = coordinate(random);
  return {x, y, coordinate(random)};
}

Pose3 DrawPose(std::mt19937& random) {
  return {.rotation = RotationFromVector(Draw(random, 1.7)), .translation_m = Draw(random, 100.0)};
}

double Difference(const Pose3& a, const Pose3& b) {
  return (a.rotation - b.rotation).norm() + (a.translation_m - b.translation_m).norm();
}

TEST(Pose3, MapsPointsFromChildToParent) {
  const Pose3 T_map_robot{.rotation = RotationFromRollPitchYaw({0.0, 0.0, kPi / 2.0}),
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
    EXPECT_NEAR(Difference(a * a.Inverse(), Pose3{}), 0.0, 1e-12);
    EXPECT_NEAR(Difference((a * b) * c, a * (b * c)), 0.0, 1e-11);
    EXPECT_NEAR(Difference((a * b).Inverse(), b.Inverse() * a.Inverse()), 0.0, 1e-11);
  }
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
  const Eigen::Matrix3d R = RotationFromRollPitchYaw({0.3, kPi / 2.0, 0.8});
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

}  // namespace
}  // namespace slam6d
