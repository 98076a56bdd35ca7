// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/driver.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

TEST(Driver, PlaysRecordedCommandsBackInTime) {
  Driver driver(
      {.kind = DriverKind::kRecorded, .commands = {{1.0, 0.5, 0.0}, {2.0, 0.0, -0.3}}}, {}, 1);
  EXPECT_EQ(driver.Decide({.now = 500ms}).forward_mps, 0.0);
  EXPECT_EQ(driver.Decide({.now = 1500ms}).forward_mps, 0.5);
  EXPECT_FALSE(driver.has_arrived());
  EXPECT_EQ(driver.Decide({.now = 2000ms}).turn_rad_s, -0.3);
  EXPECT_TRUE(driver.has_arrived());
}

TEST(Driver, ExternalDriverHoldsTheLastCommandAndNeverArrives) {
  Driver driver({.kind = DriverKind::kExternal}, {}, 1);
  driver.SetCommand({.forward_mps = 0.4, .turn_rad_s = 0.1});
  EXPECT_EQ(driver.Decide({.now = 1s}).forward_mps, 0.4);
  EXPECT_EQ(driver.Decide({.now = 1h}).turn_rad_s, 0.1);
  EXPECT_FALSE(driver.has_arrived());
}

TEST(Driver, SkilledDriverStopsForWhatIsInTheWay) {
  Driver driver({}, {{10.0, 0.0}}, 1);
  EXPECT_NEAR(driver.Decide({.free_ahead_m = 2.0}).forward_mps, 0.5, 1e-12);
  EXPECT_EQ(driver.Decide({.free_ahead_m = 0.1}).forward_mps, 0.0);
}

/// What a robot did on its way over an empty floor.
struct Way {
  double seconds = 0.0;
  double farthest_from_goal_m = 0.0;  ///< At the end.
  double fastest_turn_on_the_spot_rad_s = 0.0;
};

Way DriveSquare(DriverKind kind) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.duration_s = 200.0;
  DriverOptions& driver = scenario.robots[0].driver;
  driver.kind = kind;
  driver.waypoints = {{6.0, 0.0}, {6.0, 6.0}, {0.0, 6.0}, {0.0, 0.0}};
  Simulation simulation(scenario);
  Way way;
  while (!simulation.is_over()) {
    simulation.Step();
    const Twist2 motion = simulation.MotionOf(0);
    if (motion.velocity_mps.norm() < 0.05) {
      way.fastest_turn_on_the_spot_rad_s =
          std::max(way.fastest_turn_on_the_spot_rad_s, std::abs(motion.yaw_rate_rad_s));
    }
  }
  way.seconds = std::chrono::duration<double>(simulation.now()).count();
  way.farthest_from_goal_m = simulation.T_world_robot(0).translation_m().norm();
  return way;
}

TEST(Driver, FollowsWaypointsToTheLast) {
  for (const DriverKind kind : {DriverKind::kSkilled, DriverKind::kPoor}) {
    const Way way = DriveSquare(kind);
    EXPECT_LT(way.seconds, kind == DriverKind::kPoor ? 150.0 : 60.0);
    EXPECT_LT(way.farthest_from_goal_m, 0.45);
  }
}

TEST(Driver, PoorDriverTurnsSharplyOnTheSpot) {
  EXPECT_GT(DriveSquare(DriverKind::kPoor).fastest_turn_on_the_spot_rad_s, 0.75);
}

TEST(Driver, BacksOffWhenStuckAndTriesAgain) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.duration_s = 300.0;
  scenario.robots[0].driver.kind = DriverKind::kPoor;
  scenario.robots[0].driver.waypoints = {{4.0, 0.0}, {8.0, 0.0}};
  scenario.scenery.rounds = {{.x_m = 2.5, .y_m = 0.05, .radius_m = 0.3}};
  Simulation simulation(scenario);
  while (!simulation.is_over()) simulation.Step();
  EXPECT_GT(simulation.T_world_robot(0).x_m, 7.0);
}

}  // namespace
}  // namespace sim
