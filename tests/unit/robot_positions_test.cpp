// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/robot_positions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

TEST(RobotPositions, TellsOfOthersWhileThatIsNews) {
  RobotPositions positions;
  const RobotPositions::Time begin{};
  positions.Report("robot1", {1.0, 0.0}, begin);
  positions.Report("robot2", {2.0, 0.0}, begin);
  positions.Report("robot2", {3.0, 0.0}, begin + 500ms);
  ASSERT_EQ(positions.OthersThan("robot1", begin + 900ms).size(), 1U);
  EXPECT_EQ(positions.OthersThan("robot1", begin + 900ms)[0], Eigen::Vector2d(3.0, 0.0));
  EXPECT_EQ(positions.OthersThan("robot2", begin + 900ms).size(), 1U);
  EXPECT_EQ(positions.OthersThan("robot2", begin + 1100ms).size(), 0U);
}

TEST(HideRobots, LeavesWhatIsElsewhere) {
  LaserScan scan;
  scan.geometry = {.first_bearing_rad = -1.0F,
                   .bearing_step_rad = 0.5F,
                   .range_min_m = 0.1F,
                   .range_max_m = 10.0F,
                   .T_robot_laser = {0.5, 0.0, 0.0}};
  scan.ranges_m = {2.0F, 2.0F, 2.0F, 2.0F, 20.0F};
  // The robot looks along y; the third beam ends straight ahead of it.
  const Pose2 T_map_robot{1.0, 1.0, 0.5 * std::numbers::pi};
  HideRobots(std::vector{Eigen::Vector2d(1.0, 3.7)}, 0.3, T_map_robot, scan);
  EXPECT_TRUE(std::isnan(scan.ranges_m[2]));
  for (const std::size_t beam : {0U, 1U, 3U}) EXPECT_EQ(scan.ranges_m[beam], 2.0F);
  EXPECT_EQ(scan.ranges_m[4], 20.0F);
}

}  // namespace
}  // namespace qwsm::team
