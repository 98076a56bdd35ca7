// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

double KineticEnergy_j(const Simulation& simulation, std::size_t robot) {
  const Twist2 motion = simulation.MotionOf(robot);
  const BodyId body = simulation.robots()[robot].body();
  return 0.5 * simulation.world().MassOf(body) * motion.velocity_mps.squaredNorm() +
         0.5 * simulation.world().MomentOfInertiaOf(body) * motion.yaw_rate_rad_s *
             motion.yaw_rate_rad_s;
}

/// A closed room with a robot that drives as fast as it can, wherever that leads.
ScenarioOptions ClosedRoom(int seed) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.seed = seed;
  scenario.scenery.walls = {{-3.0, -3.0, 3.0, -3.0, 0.02},
                            {3.0, -3.0, 3.0, 3.0, 0.02},
                            {3.0, 3.0, -3.0, 3.0, 0.02},
                            {-3.0, 3.0, -3.0, -3.0, 0.02}};
  scenario.robots[0].drive.max_speed_mps = 8.0;
  scenario.robots[0].drive.max_acceleration_mps2 = 20.0;
  scenario.robots[0].laser.rate_hz = 1.0;
  return scenario;
}

TEST(Simulation, RobotsDoNotTunnelThroughThinWalls) {
  for (int seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    RandomEngine random(SeedFor("commands", static_cast<std::uint64_t>(seed)));
    Simulation simulation(ClosedRoom(seed));
    for (int i = 0; i < 40; ++i) {
      simulation.SetCommand(0, {Uniform(random, -8.0, 8.0), Uniform(random, -2.0, 2.0)});
      for (int step = 0; step < 100; ++step) {
        simulation.Step();
        const qwsm::Pose2 T_world_robot = simulation.T_world_robot(0);
        ASSERT_LT(std::abs(T_world_robot.x_m), 2.85) << "half a robot is 0.25 m";
        ASSERT_LT(std::abs(T_world_robot.y_m), 2.85);
      }
    }
  }
}

TEST(Simulation, CollisionsNeverMakeRobotsFasterThanTheirWheels) {
  for (int seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    ScenarioOptions scenario = ClosedRoom(seed);
    scenario.scenery.boxes = {{.x_m = 1.5, .y_m = 1.5, .mass_kg = 5.0}};
    RobotOptions robot = scenario.robots[0];
    robot.drive.max_speed_mps = 1.0;
    scenario.robots.clear();
    for (int i = 0; i < 4; ++i) {
      robot.name = "robot " + std::to_string(i);
      robot.start_x_m = -1.5 + 0.8 * i;
      scenario.robots.push_back(robot);
    }
    RandomEngine random(SeedFor("commands", static_cast<std::uint64_t>(seed)));
    Simulation simulation(scenario);
    while (simulation.now() < 60s) {
      if (simulation.now() % 1s == 0s) {
        for (std::size_t i = 0; i < 4; ++i) {
          simulation.SetCommand(i, {Uniform(random, -1.0, 1.0), Uniform(random, -2.0, 2.0)});
        }
      }
      simulation.Step();
      for (std::size_t i = 0; i < 4; ++i) {
        // At most the energy of rims at full speed, and what three others could hand over.
        ASSERT_LT(KineticEnergy_j(simulation, i), 4.0 * 0.5 * 30.0 * 1.0);
      }
    }
  }
}

TEST(Simulation, RobotsComeToRestWhenTheirWheelsDo) {
  for (const Surface surface : {Surface::kFloor, Surface::kGrass}) {
    ScenarioOptions scenario = testing::EmptyFloor();
    scenario.ground.everywhere = surface;
    Simulation simulation(scenario);
    simulation.SetCommand(0, {.forward_mps = 1.0, .turn_rad_s = 0.5});
    while (simulation.now() < 3s) simulation.Step();
    EXPECT_GT(KineticEnergy_j(simulation, 0), 1.0);
    simulation.SetCommand(0, {});
    while (simulation.now() < 6s) simulation.Step();
    EXPECT_LT(KineticEnergy_j(simulation, 0), 1e-6);
    const qwsm::Pose2 T_world_rest = simulation.T_world_robot(0);
    while (simulation.now() < 20s) simulation.Step();
    EXPECT_LT((T_world_rest.Inverse() * simulation.T_world_robot(0)).translation_m().norm(), 1e-4);
  }
}

TEST(Simulation, ARobotAgainstAWallSpinsItsWheels) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.scenery.walls = {{2.0, -5.0, 2.0, 5.0, 0.1}};
  Simulation simulation(scenario);
  simulation.SetCommand(0, {.forward_mps = 0.5, .turn_rad_s = 0.0});
  while (simulation.now() < 20s) simulation.Step();
  EXPECT_NEAR(simulation.T_world_robot(0).x_m, 2.0 - 0.05 - 0.25, 0.02);
  EXPECT_NEAR(simulation.robots()[0].T_odom_robot().x_m, 0.5 * 20.0, 0.2) << "odometry goes on";
}

TEST(Simulation, PersonsWalkAboutWithoutShovingRobots) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.scenery.persons = {{.waypoints = {{-3.0, 0.05}, {3.0, 0.05}}}};
  Simulation simulation(scenario);
  double leftmost_m = 0.0;
  double rightmost_m = 0.0;
  while (simulation.now() < 60s) {
    simulation.Step();
    const double x_m = simulation.world().PoseOf(simulation.persons()[0].body()).x_m;
    leftmost_m = std::min(leftmost_m, x_m);
    rightmost_m = std::max(rightmost_m, x_m);
  }
  EXPECT_LT(leftmost_m, -2.6);
  EXPECT_GT(rightmost_m, 2.6) << "got round the robot that stands in the way";
  EXPECT_LT(simulation.T_world_robot(0).translation_m().norm(), 0.05);
}

void ExpectSame(const Reading& a, const Reading& b) {
  EXPECT_EQ(a.robot, b.robot);
  EXPECT_EQ(a.scan.stamp, b.scan.stamp);
  EXPECT_EQ(a.scan.ranges_m, b.scan.ranges_m);
  EXPECT_EQ(a.T_odom_robot, b.T_odom_robot);
  EXPECT_EQ(a.T_world_robot, b.T_world_robot);
  EXPECT_EQ(a.gyro_rad, b.gyro_rad);
}

/// Everything random at once: people, four robots, noise, dropouts, skew.
ScenarioOptions BusyOffice(int seed) {
  ScenarioOptions scenario = testing::Drive(LayoutKind::kOffice, seed);
  scenario.duration_s = 30.0;
  scenario.layout.office.routes = 4;
  RobotOptions robot;
  robot.gyro.enabled = true;
  robot.laser.sweep_s = 0.05;
  robot.laser.dropout_probability = 0.01;
  scenario.robots.clear();
  for (int i = 0; i < 4; ++i) {
    robot.name = "robot " + std::to_string(i);
    scenario.robots.push_back(robot);
  }
  return scenario;
}

TEST(Simulation, IsTheSameBitForBitForTheSameSeed) {
  for (int seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Simulation first(BusyOffice(seed));
    Simulation second(BusyOffice(seed));
    int readings = 0;
    while (const std::optional<Reading> reading = first.Next()) {
      const std::optional<Reading> same = second.Next();
      ASSERT_TRUE(same.has_value());
      ExpectSame(*reading, *same);
      ++readings;
    }
    EXPECT_FALSE(second.Next().has_value());
    EXPECT_GT(readings, 4 * 290);
  }
}

TEST(Simulation, SeedsDiffer) {
  Simulation first(testing::Park(1));
  Simulation second(testing::Park(2));
  EXPECT_NE(first.Next()->scan.ranges_m, second.Next()->scan.ranges_m);
}

TEST(Simulation, NoiseOfOneSensorLeavesTheOthersAlone) {
  ScenarioOptions scenario = testing::Park(1);
  scenario.duration_s = 20.0;
  Simulation first(scenario);
  scenario.robots[0].laser.range_sigma_m = 0.0;
  Simulation second(scenario);
  while (const std::optional<Reading> reading = first.Next()) {
    const std::optional<Reading> other = second.Next();
    EXPECT_EQ(reading->T_world_robot, other->T_world_robot);
    EXPECT_EQ(reading->T_odom_robot, other->T_odom_robot);
  }
}

TEST(Simulation, ScansComeAtTheirRate) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.duration_s = 10.0;
  scenario.robots[0].laser.rate_hz = 40.0;  // Every 2.5 steps.
  Simulation simulation(scenario);
  int scans = 0;
  while (const std::optional<Reading> reading = simulation.Next()) {
    const std::chrono::duration<double> stamp = reading->scan.stamp;
    EXPECT_NEAR(stamp.count(), scans / 40.0, 0.0051);
    ++scans;
  }
  EXPECT_EQ(scans, 401);
}

TEST(Simulation, PoorOdometryOnGrassIsMetresOff) {
  Simulation simulation(testing::Park(1));
  const qwsm::Pose2 T_world_odom = simulation.T_world_robot(0);
  while (!simulation.is_over()) simulation.Step();
  const qwsm::Pose2 error =
      simulation.T_world_robot(0).Inverse() * T_world_odom * simulation.robots()[0].T_odom_robot();
  EXPECT_GT(error.translation_m().norm(), 3.0);
}

}  // namespace
}  // namespace sim
