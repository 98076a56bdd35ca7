// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios of the plane as seen in space: rays against geometry that is known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sim/pitching_laser.hpp"
#include "sim/solid_world.hpp"

namespace sim {
namespace {

SolidOptions Flat() {
  return {.terrain = {.steepest = 0.0, .wavelength_m = 10.0, .step_height_m = 0.0}};
}

Eigen::Vector3d DrawDirection(std::mt19937& random) {
  std::normal_distribution<double> any;
  const double x = any(random);
  const double y = any(random);
  return Eigen::Vector3d(x, y, any(random)).normalized();
}

TEST(SolidWorld, MeetsFlatGroundWhereItsHeightSays) {
  const SolidWorld world({}, Flat());
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Ray3 ray{{0.0, 0.0, 1.5}, DrawDirection(random)};
    const std::optional<double> range_m = world.Cast(ray, 20.0);
    const double expected_m = ray.direction.z() < 0.0 ? -1.5 / ray.direction.z() : 1e9;
    ASSERT_EQ(range_m.has_value(), expected_m <= 20.0) << "case " << i;
    ASSERT_NEAR(range_m.value_or(expected_m), expected_m, 1e-6) << "case " << i;
  }
}

TEST(SolidWorld, StopsRaysAtWallsColumnsAndTheirTops) {
  const SolidWorld world(
      {.walls = {{.from_x_m = 5.0, .from_y_m = -9.0, .to_x_m = 5.0, .to_y_m = 9.0}},
       .rounds = {{.x_m = -4.0, .y_m = 0.0, .radius_m = 0.5}}},
      Flat());
  const Eigen::Vector3d origin(0.0, 0.0, 1.0);
  EXPECT_NEAR(*world.Cast({origin, {1.0, 0.0, 0.0}}, 30.0), 4.95, 1e-9);
  EXPECT_NEAR(*world.Cast({origin, {-1.0, 0.0, 0.0}}, 30.0), 3.5, 1e-9);
  EXPECT_FALSE(world.Cast({origin, {0.0, 1.0, 0.0}}, 30.0));
  EXPECT_FALSE(world.Cast({origin, {0.0, 0.0, 1.0}}, 30.0));
  // Over the wall, which is 2.5 m high, and onto its top from above.
  EXPECT_FALSE(world.Cast({origin, Eigen::Vector3d(5.0, 0.0, 2.0).normalized()}, 30.0));
  EXPECT_NEAR(*world.Cast({{5.0, 0.0, 4.0}, {0.0, 0.0, -1.0}}, 30.0), 1.5, 1e-9);
}

TEST(SolidWorld, HasHitsOnTheGroundWithSlopesAndSteps) {
  const SolidWorld world({}, {});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-40.0, 40.0);
  int on_steps = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double x = place(random);
    const Eigen::Vector2d p(x, place(random));
    const Ray3 ray{{p.x(), p.y(), world.terrain().HeightM(p) + 0.7}, DrawDirection(random)};
    const std::optional<double> range_m = world.Cast(ray, 30.0);
    if (!range_m) continue;
    const Eigen::Vector3d hit = ray.origin_m + *range_m * ray.direction;
    const double above_m = hit.z() - world.terrain().HeightM(hit.head<2>());
    ASSERT_LT(above_m, 1e-6) << "case " << i;
    if (above_m < -1e-6) ++on_steps;  // Into the side of a step, which is lower than 0.08 m.
    ASSERT_GT(above_m, -0.08 - 1e-6) << "case " << i;
  }
  EXPECT_GT(on_steps, 10);
}

TEST(Terrain, RobotsStandOnTheirWheels) {
  const Terrain terrain({.step_height_m = 0.0});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-30.0, 30.0);
  for (int i = 0; i < 500; ++i) {
    const double x = any(random);
    const double y = any(random);
    const qwsm::Pose2 plane{x, y, qwsm::NormalizeAngle(any(random))};
    const slam6d::Pose3 stand = terrain.Stand(plane);
    for (const Eigen::Vector3d& wheel :
         {Eigen::Vector3d(0.2, 0, 0), Eigen::Vector3d(-0.2, 0, 0), Eigen::Vector3d(0, 0.2, 0)}) {
      const Eigen::Vector3d p = stand * wheel;
      ASSERT_NEAR(p.z(), terrain.HeightM(p.head<2>()), 2e-3) << "case " << i;
    }
  }
}

TEST(PitchingLaser, ScansLikeKurt3D) {
  const SolidWorld room(
      {.walls = {{.from_x_m = 4.0, .from_y_m = -6.0, .to_x_m = 4.0, .to_y_m = 6.0}}}, Flat());
  RandomEngine random(4);
  const PitchingLaserOptions laser{.noise_m = 0.0};
  const slam6d::Pose3 T_world_laser{.translation_m = {0.0, 0.0, 0.5}};
  const slam6d::PointCloud cloud = Scan(room, T_world_laser, laser, random);
  EXPECT_GT(cloud.size(), 181U * 256U / 3U);
  EXPECT_LE(cloud.size(), 181U * 256U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = T_world_laser * cloud[i];
    const bool is_on_ground = std::abs(p.z()) < 1e-6;
    const bool is_on_wall = p.z() > 0.0 && p.z() < 2.5 && p.x() > 3.9;
    ASSERT_TRUE(is_on_ground || is_on_wall) << p.transpose();
    ASSERT_GE(p.x(), -1e-9);  // 180 degrees: nothing behind.
  }
}

}  // namespace
}  // namespace sim
