// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"
#include "tests/support/simulated_laser.hpp"
#include "tests/support/world.hpp"

namespace qwsm::test {
namespace {

using std::numbers::pi;

Eigen::Vector2d Towards(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

TEST(CastRay, MeasuresWallsExactly) {
  const World world{.walls = {{{2.0, -1.0}, {2.0, 1.0}}, {{5.0, -9.0}, {5.0, 9.0}}}, .columns = {}};
  EXPECT_DOUBLE_EQ(*CastRay(world, {0.0, 0.0}, Towards(0.0)), 2.0);
  EXPECT_NEAR(*CastRay(world, {0.0, 0.0}, Towards(pi / 4)), 5.0 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(CastRay(world, {0.0, 0.0}, Towards(pi)), std::nullopt);
  EXPECT_DOUBLE_EQ(*CastRay(world, {0.0, 1.5}, Towards(0.0)), 5.0);
}

TEST(CastRay, MeasuresColumnsExactly) {
  const World world{.walls = {}, .columns = {{.center_m = {3.0, 0.0}, .radius_m = 0.5}}};
  EXPECT_DOUBLE_EQ(*CastRay(world, {0.0, 0.0}, Towards(0.0)), 2.5);
  EXPECT_NEAR(*CastRay(world, {0.0, 0.3}, Towards(0.0)), 3.0 - 0.4, 1e-12);
  EXPECT_EQ(CastRay(world, {0.0, 0.6}, Towards(0.0)), std::nullopt);
  EXPECT_EQ(CastRay(world, {0.0, 0.0}, Towards(pi)), std::nullopt);
}

TEST(SceneFromDrawing, StandsOnItsLowerLeftCorner) {
  const Scene scene = SceneFromDrawing(
      "####\n"
      "#1o#\n"
      "#.2#\n"
      "####\n",
      0.5);
  ASSERT_EQ(scene.route_m.size(), 2U);
  EXPECT_EQ(scene.route_m[0], Eigen::Vector2d(0.75, 1.25));
  EXPECT_EQ(scene.route_m[1], Eigen::Vector2d(1.25, 0.75));
  ASSERT_EQ(scene.world.columns.size(), 1U);
  EXPECT_EQ(scene.world.columns[0].center_m, Eigen::Vector2d(1.25, 1.25));
  EXPECT_EQ(scene.world.walls.size(), 8U);  // The outline inside and outside.
  EXPECT_DOUBLE_EQ(*CastRay(scene.world, scene.route_m[1], Towards(0.0)), 0.25);
  EXPECT_DOUBLE_EQ(*CastRay(scene.world, scene.route_m[1], Towards(pi)), 0.75);
}

TEST(SceneFromDrawing, RefusesAnUnclearRoute) {
  EXPECT_THROW(SceneFromDrawing("1 2 2", 1.0), std::invalid_argument);
  EXPECT_THROW(SceneFromDrawing("1 3", 1.0), std::invalid_argument);
}

TEST(SimulatedLaser, ReadsTheTruthWithoutNoise) {
  const World world{.walls = {{{2.0, -9.0}, {2.0, 9.0}}}, .columns = {}};
  SimulatedLaser laser{.beams = 3, .range_max_m = 8.0, .range_sigma_m = 0.0};
  laser.bearing_sigma_rad = 0.0;
  laser.lost_echo_share = 0.0;
  laser.T_robot_laser = {0.5, 0.0, 0.0};
  std::mt19937_64 random(1);
  const LaserScan ahead = Measure(laser, world, {0.0, 0.0, 0.0}, random);
  EXPECT_FLOAT_EQ(ahead.ranges_m[1], 1.5F);
  EXPECT_EQ(StateOf(ahead.ranges_m[0], ahead.geometry), BeamState::kMiss);
  const LaserScan turned_left = Measure(laser, world, {0.0, 0.0, pi / 2}, random);
  EXPECT_FLOAT_EQ(turned_left.ranges_m[0], 2.0F);  // The right beam.
}

TEST(SimulatedLaser, NoiseHasTheDeviationAskedFor) {
  const World world{.walls = {{{4.0, -90.0}, {4.0, 90.0}}}, .columns = {}};
  SimulatedLaser laser{.beams = 3, .field_of_view_rad = 1e-3, .range_sigma_m = 0.03};
  laser.lost_echo_share = 0.0;
  std::mt19937_64 random(5);
  double sum_of_squares_m2 = 0.0;
  constexpr int kScans = 3000;
  for (int i = 0; i < kScans; ++i) {
    const double error_m = static_cast<double>(Measure(laser, world, {}, random).ranges_m[1]) - 4.0;
    sum_of_squares_m2 += error_m * error_m;
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares_m2 / kScans), 0.03, 0.0015);
}

TEST(SimulatedDrive, IsTheSameForTheSameSeed) {
  const Scene scene = TwoRoomsAndCorridor();
  const SimulatedDrive a = DriveThrough(scene, {.seed = 3});
  const SimulatedDrive b = DriveThrough(scene, {.seed = 3});
  const SimulatedDrive other = DriveThrough(scene, {.seed = 4});
  ASSERT_EQ(a.observations.size(), b.observations.size());
  EXPECT_EQ(a.T_world_robot, other.T_world_robot);
  EXPECT_EQ(a.observations.back().scan.ranges_m, b.observations.back().scan.ranges_m);
  EXPECT_EQ(a.observations.back().T_odom_robot, b.observations.back().T_odom_robot);
  EXPECT_NE(a.observations.back().scan.ranges_m, other.observations.back().scan.ranges_m);
}

TEST(SimulatedDrive, OdometryIsTheTruthWithoutErrors) {
  const OdometryErrors none{.position_sigma_m_per_sqrt_m = 0.0,
                            .heading_sigma_rad_per_sqrt_m = 0.0,
                            .heading_sigma_rad_per_sqrt_rad = 0.0,
                            .path_scale = 1.0,
                            .turn_scale = 1.0};
  const SimulatedDrive drive = DriveThrough(TwoRoomsAndCorridor(), {.odometry = none});
  const Pose2 T_world_odom = drive.T_world_robot.front();
  const Pose2 T_world_robot = T_world_odom * *drive.observations.back().T_odom_robot;
  EXPECT_NEAR((T_world_robot.translation_m() - drive.T_world_robot.back().translation_m()).norm(),
              0.0,
              1e-9);
}

TEST(SimulatedDrive, OdometryErrsAsToldHoweverOftenItIsSampled) {
  OdometryErrors errors{.position_sigma_m_per_sqrt_m = 0.05, .heading_sigma_rad_per_sqrt_m = 0.0};
  errors.path_scale = 1.0;
  for (const int samples : {1, 50}) {
    SCOPED_TRACE(samples);
    std::vector<Pose2> straight;
    for (int i = 0; i <= samples; ++i) straight.push_back({9.0 * i / samples, 0.0, 0.0});
    std::mt19937_64 random(11);
    double sum_of_squares_m2 = 0.0;
    constexpr int kDrives = 2000;
    for (int i = 0; i < kDrives; ++i) {
      const double error_m = ErringOdometry(straight, errors, random).back().x_m - 9.0;
      sum_of_squares_m2 += error_m * error_m;
    }
    EXPECT_NEAR(std::sqrt(sum_of_squares_m2 / kDrives), 0.05 * 3.0, 0.01);
  }
}

std::vector<Scene> IndoorScenes() {
  return {FurnishedRoom(), TwoRoomsAndCorridor(), LongCorridor(), OfficeLoop()};
}

// Distances in 32 directions to what is nearest there.
std::vector<std::optional<double>> ClearancesAround(const World& world,
                                                    const Pose2& T_world_robot) {
  std::vector<std::optional<double>> clearances_m;
  for (int i = 0; i < 32; ++i) {
    clearances_m.push_back(CastRay(world, T_world_robot.translation_m(), Towards(i * pi / 16)));
  }
  return clearances_m;
}

TEST(Scenes, IndoorsAreClosed) {
  for (const Scene& scene : IndoorScenes()) {
    SCOPED_TRACE("scene with " + std::to_string(scene.world.walls.size()) + " walls");
    for (const Pose2& T_world_robot : PosesAlong(scene.route_m, {})) {
      for (const auto& clearance_m : ClearancesAround(scene.world, T_world_robot)) {
        ASSERT_TRUE(clearance_m) << T_world_robot.translation_m().transpose();
      }
    }
  }
}

TEST(Scenes, LeaveRoomForARobotHalfAMetreWide) {
  std::vector<Scene> scenes = IndoorScenes();
  scenes.push_back(Park());
  for (const Scene& scene : scenes) {
    SCOPED_TRACE("scene with " + std::to_string(scene.world.walls.size()) + " walls");
    for (const Pose2& T_world_robot : PosesAlong(scene.route_m, {})) {
      for (const auto& clearance_m : ClearancesAround(scene.world, T_world_robot)) {
        ASSERT_GT(clearance_m.value_or(1e9), 0.25) << T_world_robot.translation_m().transpose();
      }
    }
  }
}

TEST(Scenes, ReturnToWhereTheyBegan) {
  std::vector<Scene> scenes = IndoorScenes();
  scenes.push_back(Park());
  for (const Scene& scene : scenes) {
    SCOPED_TRACE("scene with " + std::to_string(scene.world.walls.size()) + " walls");
    const std::vector<Pose2> poses = PosesAlong(scene.route_m, {});
    double return_m = 1e9;
    for (std::size_t i = poses.size() / 2; i < poses.size(); ++i) {
      const Eigen::Vector2d away_m = poses[i].translation_m() - poses[0].translation_m();
      return_m = std::min(return_m, away_m.norm());
    }
    EXPECT_LT(return_m, 2.5);
  }
}

// What the scene is for: little to see, but rarely nothing.
TEST(Scenes, ParkShowsOneOrTwoTreesMostOfTheTime) {
  const World park = Park().world;
  int few = 0;
  int none = 0;
  const std::vector<Pose2> poses = PosesAlong(Park().route_m, {});
  for (const Pose2& T_world_robot : poses) {
    int seen = 0;
    for (const Column& tree : park.columns) {
      const Eigen::Vector2d p_robot_m = T_world_robot.Inverse() * tree.center_m;
      if (p_robot_m.x() > 0.0 && p_robot_m.norm() < 11.0) ++seen;
    }
    if (seen == 1 || seen == 2) ++few;
    if (seen == 0) ++none;
  }
  EXPECT_GT(few, static_cast<int>(poses.size()) / 2);
  EXPECT_LT(none, static_cast<int>(poses.size()) / 10);
}

}  // namespace
}  // namespace qwsm::test
