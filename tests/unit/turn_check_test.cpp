// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/turn_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/simulated_laser.hpp"

namespace qwsm {
namespace {

/// Turns to and fro in a room with something in it, and says whether the check objects.
bool Objects(float side, double turn_rad) {
  const test::World room{.walls = {{{-4, -3}, {4, -3}},
                                   {{4, -3}, {4, 3}},
                                   {{4, 3}, {-4, 3}},
                                   {{-4, 3}, {-4, -3}},
                                   {{2, 1}, {2, 3}},
                                   {{-1, -3}, {-1, -2}}},
                         .columns = {}};
  std::mt19937_64 random(2);
  TurnCheck check;
  Pose2 T_odom_robot{0.3, 0.2, 0.0};
  for (int i = 0; i < 60; ++i) {
    T_odom_robot.theta_rad = NormalizeAngle(T_odom_robot.theta_rad + turn_rad);
    LaserScan scan = test::Measure({}, room, T_odom_robot, random);
    scan.geometry.first_bearing_rad *= side;
    scan.geometry.bearing_step_rad *= side;
    check.Add(scan, T_odom_robot);
  }
  return check.turns_against_odometry();
}

TEST(TurnCheck, IsContentWithAScannerThatTurnsAsOdometry) {
  EXPECT_FALSE(Objects(1.0F, 0.1));
  EXPECT_FALSE(Objects(1.0F, -0.1));
}

TEST(TurnCheck, ObjectsToAMirroredOne) {
  EXPECT_TRUE(Objects(-1.0F, 0.1));
  EXPECT_TRUE(Objects(-1.0F, -0.1));
}

TEST(TurnCheck, SaysNothingOfARobotThatHardlyTurns) { EXPECT_FALSE(Objects(-1.0F, 0.01)); }

}  // namespace
}  // namespace qwsm
