// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace qwsm {
namespace {

using std::numbers::pi;

void ExpectNear(const Pose2& a, const Pose2& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(NormalizeAngle(a.theta_rad - b.theta_rad), 0.0, tolerance);
}

TEST(NormalizeAngle, WrapsIntoTheHalfOpenCircle) {
  EXPECT_DOUBLE_EQ(NormalizeAngle(0.5), 0.5);
  EXPECT_DOUBLE_EQ(NormalizeAngle(-pi), pi);
  EXPECT_NEAR(NormalizeAngle(3.0 * pi), pi, 1e-12);
  EXPECT_NEAR(NormalizeAngle(1.0 + 200.0 * pi), 1.0, 1e-12);
}

TEST(Pose2, MapsPointsFromChildToParent) {
  const Pose2 T_map_robot{1.0, 2.0, pi / 2.0};
  const Eigen::Vector2d p_map = T_map_robot * Eigen::Vector2d(3.0, 0.0);
  EXPECT_NEAR(p_map.x(), 1.0, 1e-12);
  EXPECT_NEAR(p_map.y(), 5.0, 1e-12);
}

TEST(Pose2, LiesBetweenTwoOthersByTheShorterTurn) {
  const Pose2 a{1.0, 2.0, 3.0};
  const Pose2 b{3.0, -2.0, -3.0};
  ExpectNear(Between(a, b, 0.0), a, 0.0);
  ExpectNear(Between(a, b, 0.5), {2.0, 0.0, pi}, 1e-12);
  ExpectNear(Between(a, b, 1.0), b, 1e-12);
  ExpectNear(Between(a, b, 1.5), {4.0, -4.0, -3.0 + 0.5 * (2.0 * pi - 6.0)}, 1e-12);
}

TEST(Pose2, ObeysTheGroupLaws) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position_m(-1e3, 1e3);
  std::uniform_real_distribution<double> heading_rad(-pi, pi);
  const auto draw = [&] {
    return Pose2{position_m(random), position_m(random), heading_rad(random)};
  };
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Pose2 a = draw();
    const Pose2 b = draw();
    const Pose2 c = draw();
    ExpectNear(a * a.Inverse(), Pose2{}, 1e-9);
    ExpectNear((a * b) * c, a * (b * c), 1e-9);
    ExpectNear((a * b).Inverse(), b.Inverse() * a.Inverse(), 1e-9);
  }
}

TEST(RigidTransform2, MapsAsThePoseDoes) {
  const Pose2 T_map_robot{1.0, -2.0, 0.7};
  const RigidTransform2 transform(T_map_robot);
  const Eigen::Vector2d p_robot(3.0, 0.5);
  EXPECT_NEAR((transform * p_robot - T_map_robot * p_robot).norm(), 0.0, 1e-15);
}

TEST(UncertainPose2, SigmasAreReadBack) {
  const UncertainPose2 pose = UncertainPose2::WithSigmas({1.0, 2.0, 0.3}, 0.1, 0.02);
  EXPECT_EQ(pose.T_a_b, (Pose2{1.0, 2.0, 0.3}));
  EXPECT_DOUBLE_EQ(pose.SigmaXY_m(), 0.1);
  EXPECT_DOUBLE_EQ(pose.SigmaTheta_rad(), 0.02);
  EXPECT_TRUE(pose.covariance.isDiagonal());
}

TEST(UncertainPose2, HeadingErrorGrowsThePositionErrorWithTheArm) {
  const UncertainPose2 turned{.T_a_b = {}, .covariance = Eigen::Vector3d(0, 0, 0.01).asDiagonal()};
  const UncertainPose2 ten_metres_ahead{.T_a_b = {10.0, 0.0, 0.0}};
  const UncertainPose2 result = turned * ten_metres_ahead;
  EXPECT_NEAR(result.covariance(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(result.covariance(1, 1), 1.0, 1e-12);
  EXPECT_NEAR(result.covariance(1, 2), 0.1, 1e-12);
}

}  // namespace
}  // namespace qwsm
