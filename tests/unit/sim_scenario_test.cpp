// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "sim/scenario.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

bool HasProblem(const ScenarioOptions& scenario, std::string_view key) {
  return std::ranges::any_of(FindProblems(scenario),
                             [key](const ScenarioProblem& problem) { return problem.key == key; });
}

TEST(Scenario, NeedsARobot) { EXPECT_TRUE(HasProblem({}, "robots")); }

TEST(Scenario, GoodOnesHaveNoProblems) {
  EXPECT_TRUE(FindProblems(testing::EmptyFloor()).empty());
  for (const LayoutKind kind : {LayoutKind::kPark,
                                LayoutKind::kCorridor,
                                LayoutKind::kOffice,
                                LayoutKind::kRubble,
                                LayoutKind::kCampus}) {
    EXPECT_TRUE(FindProblems(testing::Drive(kind, 1)).empty());
  }
}

TEST(Scenario, RefusesARobotInsideAWall) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.scenery.walls = {{.from_x_m = -1.0, .from_y_m = 0.2, .to_x_m = 1.0, .to_y_m = 0.2}};
  EXPECT_TRUE(HasProblem(scenario, "robots[0].start_x_m"));
}

TEST(Scenario, RefusesPersonsInsideSomething) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.scenery.walls = {{.from_x_m = 3.0, .from_y_m = -1.0, .to_x_m = 3.0, .to_y_m = 1.0}};
  const RobotOptions& robot = scenario.robots[0];
  scenario.scenery.persons = {{.waypoints = {{robot.start_x_m + 0.1, robot.start_y_m}}},
                              {.waypoints = {{2.0, 2.0}}},
                              {.waypoints = {{3.1, 0.5}, {2.0, 2.0}}}};
  EXPECT_TRUE(HasProblem(scenario, "scenery.persons[0].waypoints"));
  EXPECT_FALSE(HasProblem(scenario, "scenery.persons[1].waypoints"));
  EXPECT_TRUE(HasProblem(scenario, "scenery.persons[2].waypoints"));
}

TEST(Scenario, RefusesRobotsInsideEachOther) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.robots.push_back(scenario.robots[0]);
  scenario.robots[1].name = "second";
  scenario.robots[1].start_x_m = 0.3;
  EXPECT_FALSE(HasProblem(scenario, "robots[0].start_x_m"));
  EXPECT_TRUE(HasProblem(scenario, "robots[1].start_x_m"));
}

TEST(Scenario, RefusesNamesThatAreNoFiles) {
  ScenarioOptions scenario = testing::EmptyFloor();
  for (const char* name : {"", ".", "..", "../robot", "/tmp/robot", "team/robot", "a\nb", ".log"}) {
    scenario.robots[0].name = name;
    EXPECT_TRUE(HasProblem(scenario, "robots[0].name")) << name;
  }
  for (const char* name : {"robot", "robot 1", "robot-1.b", "Retter\xc3\xbc"}) {
    scenario.robots[0].name = name;
    EXPECT_FALSE(HasProblem(scenario, "robots[0].name")) << name;
  }
}

TEST(Scenario, RefusesValuesOutOfBounds) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.robots[0].laser.beams = 0;
  scenario.robots[0].mass_kg = -1.0;
  scenario.scenery.boxes = {BoxOptions{}, BoxOptions{.mass_kg = -2.0}};
  scenario.ground.grass.traction = std::numeric_limits<double>::quiet_NaN();
  for (const std::string_view key : {"robots[0].laser.beams",
                                     "robots[0].mass_kg",
                                     "scenery.boxes[1].mass_kg",
                                     "ground.grass.traction"}) {
    EXPECT_TRUE(HasProblem(scenario, key)) << key;
  }
  EXPECT_EQ(FindProblems(scenario).size(), 4U) << "each once, and all of them";
}

TEST(Scenario, RefusesContradictions) {
  ScenarioOptions scenario = testing::EmptyFloor();
  RobotOptions& robot = scenario.robots[0];
  robot.drive.track_m = 0.8;
  robot.laser.useful_range_m = 81.0;
  robot.laser.sweep_s = 0.2;
  robot.driver.kind = DriverKind::kRecorded;
  scenario.scenery.persons = {PersonOptions{}};
  scenario.ground.regions = {{Surface::kGrass, 1.0, 0.0, 0.0, 2.0}};
  scenario.layout.office.door_width_m = 3.0;
  scenario.layout.office.room_length_m = 4.0;
  for (const std::string_view key : {"robots[0].laser.useful_range_m",
                                     "robots[0].laser.sweep_s",
                                     "robots[0].driver.commands",
                                     "scenery.persons[0].waypoints",
                                     "ground.regions[0].min_x_m",
                                     "layout.office.door_width_m"}) {
    EXPECT_TRUE(HasProblem(scenario, key)) << key;
  }
  EXPECT_EQ(FindProblems(scenario).size(), 6U) << "each once, and all of them";
  robot.laser = {};
  robot.driver.kind = DriverKind::kExternal;
  EXPECT_TRUE(HasProblem(scenario, "robots[0].width_m"));
}

TEST(Scenario, RefusesWaypointsFromNowhere) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.robots[0].driver.kind = DriverKind::kSkilled;
  EXPECT_TRUE(HasProblem(scenario, "robots[0].driver.waypoints"));
}

TEST(Scenario, IsNotSimulatedWhileItHasProblems) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.robots[0].mass_kg = -1.0;
  scenario.robots[0].laser.beams = 0;
  try {
    const Simulation simulation(scenario);
    FAIL() << "nothing was thrown";
  } catch (const ScenarioError& error) {
    EXPECT_STREQ(error.what(),
                 "robots[0].mass_kg: must be between 0.1 and 10000, got -1\n"
                 "robots[0].laser.beams: must be between 1 and 100000, got 0");
  }
}

}  // namespace
}  // namespace sim
