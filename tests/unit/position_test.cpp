// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// One place decides what a position may be, and the map can hold all that it lets through.
#include "qwsm/geometry/position.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "slam6d/geometry/position.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

static_assert(kFarthestCoordinate_m == slam6d::kFarthestCoordinate_m);

TEST(Position, IsFiniteAndOnEarth) {
  EXPECT_TRUE(IsPosition({-4e6, kFarthestCoordinate_m, 3.0}));
  for (const Pose2& pose : {Pose2{kNan, 0.0, 0.0},
                            Pose2{0.0, kInfinity, 0.0},
                            Pose2{0.0, 0.0, kNan},
                            Pose2{1.1e7, 0.0, 0.0},
                            Pose2{0.0, -1e300, 0.0}}) {
    SCOPED_TRACE(pose.x_m);
    EXPECT_FALSE(IsPosition(pose));
    EXPECT_FALSE(ObjectionTo(UncertainPose2{.T_a_b = pose}).empty());
  }
}

TEST(Position, IsNoLessCertainThanAnywhereOnEarth) {
  const auto objection = [](const Eigen::Matrix3d& covariance) {
    return std::string(ObjectionTo(UncertainPose2{.T_a_b = {}, .covariance = covariance}));
  };
  EXPECT_EQ(objection(Eigen::Matrix3d::Zero()), "");
  EXPECT_EQ(objection(1e14 * Eigen::Matrix3d::Identity()), "");
  EXPECT_EQ(objection(Eigen::Matrix3d::Ones()), "");
  EXPECT_NE(objection(-Eigen::Matrix3d::Identity()), "");
  EXPECT_NE(objection(kNan * Eigen::Matrix3d::Ones()), "");
  EXPECT_EQ(objection(1e300 * Eigen::Matrix3d::Identity()),
            "the covariance is larger than that of a pose anywhere on Earth");
  Eigen::Matrix3d correlated = Eigen::Matrix3d::Identity();
  correlated(0, 1) = 1e300;
  EXPECT_EQ(objection(correlated), "the covariance has correlations beyond one");
}

TEST(Position, OfSpaceIsFiniteAndOnEarth) {
  slam6d::Pose3 pose{.translation_m = {4e6, -kFarthestCoordinate_m, 0.0}};
  EXPECT_TRUE(slam6d::IsPosition(pose));
  for (const double z_m : {kNan, kInfinity, -1.1e7}) {
    pose.translation_m.z() = z_m;
    EXPECT_FALSE(slam6d::IsPosition(pose)) << z_m;
    EXPECT_FALSE(ObjectionTo(slam6d::UncertainPose3{.T_a_b = pose}).empty()) << z_m;
  }
}

TEST(Position, OfALaserIsOnItsRobot) {
  LaserScan scan = test::ObservationInRoom(0).scan;
  EXPECT_TRUE(ObjectionTo(scan).empty());
  scan.geometry.T_robot_laser.x_m = 2e3;
  EXPECT_FALSE(ObjectionTo(scan).empty());
}

// Undefined behaviour is found by the preset `dev`, which runs this, too.
TEST(Position, WhereverOdometryLeapsToTheMapHoldsIt) {
  MapperOptions options;
  options.map.surfaces.likelihood.cell_size_m = kSmallestCell_m;
  Mapper mapper(options);
  const std::vector<Pose2> leaps{{0.0, 0.0, 0.0},
                                 {kFarthestCoordinate_m, 0.0, 3.0},
                                 {-kFarthestCoordinate_m, kFarthestCoordinate_m, 0.0},
                                 {kFarthestCoordinate_m, -kFarthestCoordinate_m, -1.5},
                                 {0.0, 0.0, 0.0}};
  for (int round = 0; round < 3; ++round) {
    for (const Pose2& leap : leaps) {
      Observation observation = test::ObservationInRoom(round);
      observation.T_odom_robot = leap;
      const MappingStep step = mapper.Process(observation);
      EXPECT_TRUE(IsPosition(step.map_robot.T_a_b)) << step.map_robot.T_a_b.x_m;
    }
  }
}

}  // namespace
}  // namespace qwsm
