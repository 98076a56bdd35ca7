// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/physics_world.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

constexpr Rectangle kRobot{.length_m = 0.5, .width_m = 0.4};

TEST(PhysicsWorld, RayEndsAtTheNearestSurface) {
  PhysicsWorld world;
  const BodyId robot = world.AddDriven(kRobot, {}, 30.0);
  world.AddFixed(Rectangle{1.0, 4.0}, {6.0, 0.0, 0.0});
  world.AddFixed(Disc{0.5}, {3.0, 0.3, 0.0});
  EXPECT_NEAR(world.CastRay({0.0, 0.0}, 0.0, 10.0, robot), 2.6, 1e-6);
  EXPECT_NEAR(world.CastRay({0.0, -1.0}, 0.0, 10.0, robot), 5.5, 1e-5);
  EXPECT_TRUE(std::isinf(world.CastRay({0.0, 0.0}, 2.0, 10.0, robot)));
}

TEST(PhysicsWorld, RayIsNotStoppedByItsOwnBodyOrBeyondItsLength) {
  PhysicsWorld world;
  const BodyId robot = world.AddDriven(kRobot, {}, 30.0);
  const BodyId other = world.AddDriven(kRobot, {2.0, 0.0, 0.0}, 30.0);
  EXPECT_NEAR(world.CastRay({0.0, 0.0}, 0.0, 10.0, robot), 1.75, 1e-5);
  EXPECT_NEAR(world.CastRay({2.0, 0.0}, std::numbers::pi, 10.0, other), 1.75, 1e-5);
  EXPECT_TRUE(std::isinf(world.CastRay({0.0, 0.0}, 0.0, 1.7, robot)));
}

TEST(PhysicsWorld, GrazesAThinTrunkFarAway) {
  PhysicsWorld world;
  const BodyId robot = world.AddDriven(kRobot, {}, 30.0);
  world.AddFixed(Disc{0.12}, {75.0, 0.0, 0.0});
  const double tangent_rad = std::asin(0.12 / 75.0);
  EXPECT_NEAR(world.CastRay({0.0, 0.0}, 0.0, 80.0, robot), 74.88, 1e-5);
  EXPECT_NEAR(world.CastRay({0.0, 0.0}, 0.999 * tangent_rad, 80.0, robot), 75.0, 0.01);
  EXPECT_TRUE(std::isinf(world.CastRay({0.0, 0.0}, 1.001 * tangent_rad, 80.0, robot)));
}

TEST(PhysicsWorld, WrenchAcceleratesByMassAndInertia) {
  PhysicsWorld world;
  const BodyId robot = world.AddDriven(kRobot, {}, 20.0);
  EXPECT_NEAR(world.MomentOfInertiaOf(robot), 20.0 * (0.25 + 0.16) / 12.0, 1e-5);
  world.Apply(robot, {.force_n = {40.0, 0.0}, .torque_nm = 1.0});
  world.Step(10ms);
  EXPECT_NEAR(world.TwistOf(robot).velocity_mps.x(), 40.0 / 20.0 * 0.01, 1e-6);
  EXPECT_NEAR(world.TwistOf(robot).yaw_rate_rad_s, 0.01 / world.MomentOfInertiaOf(robot), 1e-6);
  world.Step(10ms);
  EXPECT_NEAR(world.TwistOf(robot).velocity_mps.x(), 0.02, 1e-6) << "the wrench acted on one step";
}

TEST(PhysicsWorld, LooseBodySlidesOnlyWhenPushedHarderThanItsFriction) {
  PhysicsWorld world;
  const BodyId box = world.AddLoose(Rectangle{0.4, 0.4}, {}, 10.0, 50.0);
  for (int step = 0; step < 100; ++step) {
    world.Apply(box, {.force_n = {45.0, 0.0}, .torque_nm = 0.0});
    world.Step(10ms);
  }
  EXPECT_NEAR(world.PoseOf(box).x_m, 0.0, 1e-3);
  for (int step = 0; step < 100; ++step) {
    world.Apply(box, {.force_n = {70.0, 0.0}, .torque_nm = 0.0});
    world.Step(10ms);
  }
  EXPECT_NEAR(world.TwistOf(box).velocity_mps.x(), (70.0 - 50.0) / 10.0, 0.05);
}

TEST(PhysicsWorld, KnowsWhatIsOccupied) {
  PhysicsWorld world;
  world.AddFixed(Rectangle{4.0, 0.1}, {0.0, 1.0, 0.0});
  EXPECT_FALSE(world.IsOccupied(kRobot, {0.0, 0.6, 0.0}));
  EXPECT_TRUE(world.IsOccupied(kRobot, {0.0, 0.8, 0.0}));
  EXPECT_TRUE(world.IsOccupied(kRobot, {0.0, 0.72, std::numbers::pi / 2.0}))
      << "its corner reaches the wall";
  EXPECT_TRUE(world.IsOccupied(Disc{0.3}, {1.0, 1.2, 0.0}));
}

}  // namespace
}  // namespace sim
