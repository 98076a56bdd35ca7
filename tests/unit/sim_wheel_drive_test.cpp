// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulation.hpp"
#include "sim/wheel_drive.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

/// How far and how much a robot really went, and what its wheels say.
struct Outcome {
  double travelled_m = 0.0;
  double turned_rad = 0.0;
  double odometry_m = 0.0;
  double odometry_rad = 0.0;

  /// By which share odometry says too much.
  double travel_slip() const { return odometry_m / travelled_m - 1.0; }
  double turn_slip() const { return odometry_rad / turned_rad - 1.0; }
};

/// Six seconds of one command, and two to come to rest.
Outcome Drive(DriveType type, Surface surface, const VelocityCommand& command) {
  ScenarioOptions scenario = testing::EmptyFloor();
  scenario.ground.everywhere = surface;
  scenario.ground.grass.patchiness = 0.0;
  scenario.robots[0].drive.type = type;
  Simulation simulation(scenario);
  simulation.SetCommand(0, command);
  Outcome outcome;
  qwsm::Pose2 T_world_robot = simulation.T_world_robot(0);
  qwsm::Pose2 T_odom_robot = simulation.robots()[0].T_odom_robot();
  while (simulation.now() < 8s) {
    if (simulation.now() == 6s) simulation.SetCommand(0, {});
    simulation.Step();
    const qwsm::Pose2 moved = T_world_robot.Inverse() * simulation.T_world_robot(0);
    const qwsm::Pose2 read = T_odom_robot.Inverse() * simulation.robots()[0].T_odom_robot();
    outcome.travelled_m += moved.translation_m().norm();
    outcome.turned_rad += moved.theta_rad;
    outcome.odometry_m += read.translation_m().norm();
    outcome.odometry_rad += read.theta_rad;
    T_world_robot = T_world_robot * moved;
    T_odom_robot = T_odom_robot * read;
  }
  return outcome;
}

constexpr VelocityCommand kStraight{.forward_mps = 0.5, .turn_rad_s = 0.0};
constexpr VelocityCommand kWideArc{.forward_mps = 0.5, .turn_rad_s = 0.2};
constexpr VelocityCommand kSharpTurn{.forward_mps = 0.0, .turn_rad_s = 0.8};

TEST(WheelDrive, DoesAsToldOnFirmFloor) {
  for (const DriveType type : {DriveType::kSkidSteer, DriveType::kDifferential}) {
    EXPECT_NEAR(Drive(type, Surface::kFloor, kStraight).travelled_m, 3.0, 0.01);
    EXPECT_NEAR(Drive(type, Surface::kFloor, kWideArc).turned_rad, 1.2, 0.01);
    EXPECT_NEAR(Drive(type, Surface::kFloor, kSharpTurn).turned_rad, 4.8, 0.05);
  }
}

TEST(WheelDrive, OdometryIsRightOnFirmFloor) {
  for (const VelocityCommand& command : {kStraight, kWideArc}) {
    EXPECT_LT(std::abs(Drive(DriveType::kSkidSteer, Surface::kFloor, command).travel_slip()), 0.01);
  }
  for (const VelocityCommand& command : {kWideArc, kSharpTurn}) {
    EXPECT_LT(std::abs(Drive(DriveType::kSkidSteer, Surface::kFloor, command).turn_slip()), 0.015);
  }
}

TEST(WheelDrive, WheelsSlipOnGrass) {
  const Outcome outcome = Drive(DriveType::kSkidSteer, Surface::kGrass, kStraight);
  EXPECT_GT(outcome.travel_slip(), 0.02);
  EXPECT_LT(outcome.travel_slip(), 0.10);
}

TEST(WheelDrive, SkidSteerSlipsMoreTheSharperItTurnsOnGrass) {
  const double in_arc = Drive(DriveType::kSkidSteer, Surface::kGrass, kWideArc).turn_slip();
  const double on_the_spot = Drive(DriveType::kSkidSteer, Surface::kGrass, kSharpTurn).turn_slip();
  EXPECT_GT(in_arc, 0.05);
  EXPECT_GT(on_the_spot, 1.5 * in_arc);
  EXPECT_LT(on_the_spot, 0.5);
}

TEST(WheelDrive, DifferentialDriveDoesNotScrub) {
  const double on_the_spot =
      Drive(DriveType::kDifferential, Surface::kGrass, kSharpTurn).turn_slip();
  EXPECT_LT(on_the_spot, 0.06) << "only rolling resistance makes its wheels slip";
}

TEST(WheelDrive, PushesNoHarderThanFrictionAllows) {
  constexpr double kMass_kg = 30.0;
  const Ground ground({}, 1);
  const double limit_n = SurfaceOptions{}.traction * kMass_kg * 9.81;
  WheelDrive drive({.max_acceleration_mps2 = 1000.0}, kMass_kg, 1.0);
  drive.Drive({.forward_mps = 1.0}, 10ms);  // The rims spin at full speed at once.
  const Wrench2 push = drive.Push(ground, {}, {}, 10ms);
  EXPECT_GT(push.force_n.x(), 0.98 * limit_n);
  EXPECT_LT(push.force_n.x(), 1.001 * limit_n);
}

TEST(WheelDrive, BrakesASlidingRobotByFriction) {
  constexpr double kMass_kg = 30.0;
  const Ground ground({}, 1);
  const WheelDrive drive({}, kMass_kg, 1.0);  // Wheels stand still.
  const Twist2 sideways{.velocity_mps = {0.0, 2.0}, .yaw_rate_rad_s = 0.0};
  const Wrench2 push = drive.Push(ground, {}, sideways, 10ms);
  EXPECT_NEAR(push.force_n.y(), -SurfaceOptions{}.lateral * kMass_kg * 9.81, 1.0);
  EXPECT_NEAR(push.force_n.x(), 0.0, 1e-9);
}

TEST(WheelDrive, TooFastACommandKeepsItsCurve) {
  WheelDrive drive({.type = DriveType::kDifferential, .track_m = 0.5, .max_speed_mps = 1.0}, 30, 1);
  for (int step = 0; step < 1000; ++step) {
    drive.Drive({.forward_mps = 2.0, .turn_rad_s = 4.0}, 10ms);
  }
  EXPECT_NEAR(drive.rims().right_mps, 1.0, 1e-9);
  EXPECT_NEAR(drive.rims().left_mps, 1.0 / 3.0, 1e-9);
}

}  // namespace
}  // namespace sim
