// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/sim_scenarios.hpp"

namespace sim::testing {

ScenarioOptions EmptyFloor() {
  RobotOptions robot;
  robot.odometry.travel_noise_m = 0.0;
  robot.odometry.calibration = {.scale_sigma = 0.0, .balance_sigma = 0.0, .turn_sigma = 0.0};
  robot.laser.range_sigma_m = 0.0;
  robot.driver.kind = DriverKind::kExternal;
  ScenarioOptions scenario;
  scenario.robots = {robot};
  return scenario;
}

ScenarioOptions Drive(LayoutKind kind, int seed) {
  ScenarioOptions scenario;
  scenario.seed = seed;
  scenario.layout.kind = kind;
  scenario.robots = {RobotOptions{}};
  return scenario;
}

ScenarioOptions Park(int seed) {
  ScenarioOptions scenario = Drive(LayoutKind::kPark, seed);
  scenario.ground.everywhere = Surface::kGrass;
  RobotOptions& robot = scenario.robots.front();
  robot.odometry.calibration = {.scale_sigma = 0.0, .balance_sigma = 0.0, .turn_sigma = 0.0};
  robot.laser.rate_hz = 1.0;
  robot.laser.useful_range_m = 20.0;
  robot.driver.kind = DriverKind::kPoor;
  robot.driver.speed_mps = 0.28;
  robot.driver.arrival_m = 1.0;
  return scenario;
}

}  // namespace sim::testing
