// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What befalls robots of a team in the simulator: they join late, are carried, and say wrongly
// where they start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/layouts/office.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

using qwsm::Pose2;

/// Two robots that drive along y = 0 and y = 5, past a way point every two metres.
ScenarioOptions TwoOnTheirWays() {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.duration_s = 10.0;
  RobotOptions& robot = scenario.robots.front();
  robot.driver.kind = DriverKind::kSkilled;
  for (double x_m = 0.0; x_m < 20.0; x_m += 2.0) robot.driver.waypoints.push_back({x_m, 0.0});
  scenario.robots.push_back(robot);
  RobotOptions& other = scenario.robots.back();
  other.name = "other";
  other.start_y_m = 5.0;
  for (WaypointOptions& waypoint : other.driver.waypoints) waypoint.y_m = 5.0;
  return scenario;
}

std::vector<Reading> Readings(const ScenarioOptions& scenario, std::size_t robot) {
  Simulation simulation(scenario);
  std::vector<Reading> readings;
  while (std::optional<Reading> reading = simulation.Next()) {
    if (reading->robot == robot) readings.push_back(*reading);
  }
  return readings;
}

TEST(SimulatedTeam, ARobotThatJoinsLateStandsAndIsSilentUntilThen) {
  ScenarioOptions scenario = TwoOnTheirWays();
  scenario.robots[1].joins_at_s = 4.0;
  const std::vector<Reading> at_once = Readings(scenario, 0);
  const std::vector<Reading> late = Readings(scenario, 1);
  ASSERT_FALSE(late.empty());
  EXPECT_EQ(at_once.front().scan.stamp, qwsm::Timestamp());
  EXPECT_EQ(late.front().scan.stamp, std::chrono::seconds(4));
  EXPECT_EQ(late[1].scan.stamp - late[0].scan.stamp, at_once[1].scan.stamp - at_once[0].scan.stamp);
  EXPECT_NEAR(late.front().T_world_robot.x_m, 0.0, 0.01);
  EXPECT_GT(late.back().T_world_robot.x_m, 1.0);
}

TEST(SimulatedTeam, ARobotThatIsCarriedGoesOnElsewhereAndItsWheelsTellNothing) {
  ScenarioOptions scenario = TwoOnTheirWays();
  scenario.robots[1].carried = {{.at_s = 5.0, .waypoints = 3}};
  const std::vector<Reading> readings = Readings(scenario, 1);
  double farthest_m = 0.0;
  double farthest_by_wheels_m = 0.0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const Pose2 moved = readings[i - 1].T_world_robot.Inverse() * readings[i].T_world_robot;
    const Pose2 by_wheels = readings[i - 1].T_odom_robot.Inverse() * readings[i].T_odom_robot;
    farthest_m = std::max(farthest_m, moved.translation_m().norm());
    farthest_by_wheels_m = std::max(farthest_by_wheels_m, by_wheels.translation_m().norm());
  }
  EXPECT_GT(farthest_m, 4.0);
  EXPECT_LT(farthest_by_wheels_m, 1.0);
  EXPECT_NEAR(readings.back().T_world_robot.y_m, 5.0, 0.1);
  EXPECT_GT(readings.back().T_world_robot.x_m, 8.5);  // It drives on from there.
}

TEST(SimulatedTeam, ARobotIsNotPutDownWhereAnotherOneStands) {
  ScenarioOptions scenario = TwoOnTheirWays();
  scenario.robots[0].driver.kind = DriverKind::kExternal;  // Stands.
  scenario.robots[0].start_x_m = 6.0;
  scenario.robots[0].start_y_m = 5.0;
  scenario.robots[1].carried = {{.at_s = 0.0, .waypoints = 3}};
  const std::vector<Reading> readings = Readings(scenario, 1);
  for (const Reading& reading : readings) EXPECT_GT(std::abs(reading.T_world_robot.x_m - 6.0), 0.5);
  EXPECT_GT(readings.back().T_world_robot.x_m, 7.5);  // As soon as there is room, farther on.
}

TEST(SimulatedTeam, ToldStartsAreOffAsMuchAsWanted) {
  RobotOptions robot;
  robot.told_start_off_x_m = 6.0;
  robot.told_start_off_y_m = -1.0;
  robot.told_start_off_heading_rad = 0.5;
  const Pose2 told = ToldStart(robot, {1.0, 2.0, 3.0});
  EXPECT_EQ(told.x_m, 7.0);
  EXPECT_EQ(told.y_m, 1.0);
  EXPECT_NEAR(told.theta_rad, qwsm::NormalizeAngle(3.5), 1e-12);
}

TEST(SimulatedTeam, RobotsThatShareARouteMayStartAlongIt) {
  ScenarioOptions scenario = testing::Drive(LayoutKind::kCampus, 1);
  scenario.robots.push_back(scenario.robots.front());
  scenario.robots[1].name = "other";
  EXPECT_EQ(FindProblems(scenario).size(), 1U);  // Both start in one place.
  scenario.robots[1].start_on_route = 0.5;
  EXPECT_TRUE(FindProblems(scenario).empty());
  const Simulation simulation(scenario);
  const Eigen::Vector2d apart_m =
      simulation.T_world_robot(1).translation_m() - simulation.T_world_robot(0).translation_m();
  EXPECT_GT(apart_m.norm(), 10.0);
}

TEST(SimulatedTeam, WingsOfAnOfficeAreAlikeDownToTheFurniture) {
  OfficeOptions options;
  options.wings = 2;
  options.persons = 0;
  options.routes = 4;
  RandomEngine random(1);
  const Place place = MakeOffice(options, random);
  const double wing_m = options.rooms_per_side * options.room_length_m;
  const std::vector<RoundOptions>& legs = place.scenery.rounds;
  ASSERT_EQ(legs.size(), 2U * 2U * 4U * 4U);
  for (std::size_t i = 0; i < legs.size() / 2; ++i) {
    EXPECT_NEAR(legs[i + legs.size() / 2].x_m, legs[i].x_m + wing_m, 1e-9);
    EXPECT_EQ(legs[i + legs.size() / 2].y_m, legs[i].y_m);
  }
  ASSERT_EQ(place.routes.size(), 4U);
  EXPECT_NEAR(place.routes[1].front().x_m, place.routes[0].front().x_m + wing_m, 1e-9);
}

TEST(SimulatedTeam, ContradictionsAreRefused) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.robots[0].carried = {{.at_s = 2.0, .waypoints = 1}};
  scenario.robots[0].tells_start = false;
  scenario.robots[0].told_start_off_x_m = 1.0;
  std::vector<std::string> keys;
  for (const ScenarioProblem& problem : FindProblems(scenario)) keys.push_back(problem.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"robots[0].carried", "robots[0].tells_start"}));
  scenario = TwoOnTheirWays();
  scenario.robots[0].carried = {{.at_s = 2.0}, {.at_s = 1.0}};
  ASSERT_EQ(FindProblems(scenario).size(), 1U);
  EXPECT_EQ(FindProblems(scenario).front().what, "must be in the order of its at_s");
}

}  // namespace
}  // namespace sim
