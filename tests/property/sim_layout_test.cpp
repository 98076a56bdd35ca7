// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "sim/layouts/layout.hpp"
#include "sim/physics_world.hpp"
#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

/// Whether a robot of half a metre could stand everywhere on a route.
bool IsClear(const Place& place, const Route& route) {
  PhysicsWorld world;
  Build(place.scenery, world);
  const Route steps = Refined(route, 0.1);
  return std::ranges::none_of(steps, [&](const WaypointOptions& step) {
    return world.IsOccupied(Disc{0.3}, {step.x_m, step.y_m, 0.0});
  });
}

class EveryLayout : public ::testing::TestWithParam<LayoutKind> {};

TEST_P(EveryLayout, LeavesItsRoutesClear) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    LayoutOptions options;
    options.kind = GetParam();
    options.office.routes = 4;
    const Place place = MakePlace(options, seed);
    ASSERT_FALSE(place.routes.empty());
    for (const Route& route : place.routes) EXPECT_TRUE(IsClear(place, route));
  }
}

TEST_P(EveryLayout, IsTheSameForTheSameSeed) {
  LayoutOptions options;
  options.kind = GetParam();
  const auto text = [&](std::uint64_t seed) {
    std::vector<double> numbers;
    const Place place = MakePlace(options, seed);
    for (const WallOptions& wall : place.scenery.walls) {
      numbers.insert(numbers.end(), {wall.from_x_m, wall.from_y_m, wall.to_x_m, wall.to_y_m});
    }
    for (const BoxOptions& box : place.scenery.boxes) {
      numbers.insert(numbers.end(), {box.x_m, box.y_m, box.length_m, box.width_m});
    }
    for (const RoundOptions& thing : place.scenery.rounds) {
      numbers.insert(numbers.end(), {thing.x_m, thing.y_m, thing.radius_m});
    }
    return numbers;
  };
  EXPECT_EQ(text(1), text(1));
  if (GetParam() != LayoutKind::kCorridor) {
    EXPECT_NE(text(1), text(2));
  }
}

INSTANTIATE_TEST_SUITE_P(Layouts,
                         EveryLayout,
                         ::testing::Values(LayoutKind::kPark,
                                           LayoutKind::kCorridor,
                                           LayoutKind::kOffice,
                                           LayoutKind::kRubble,
                                           LayoutKind::kCampus),
                         [](const auto& instance) {
                           for (const auto& [name, kind] : Names(instance.param)) {
                             if (kind == instance.param) return std::string(name);
                           }
                           return std::string("unknown");
                         });

TEST(Park, TrunksAreAsThickAsAskedForAndStandInThePark) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    RandomEngine random(seed);
    const ParkOptions options;
    for (const RoundOptions& tree : MakePark(options, random).scenery.rounds) {
      EXPECT_GE(tree.radius_m, options.min_trunk_radius_m);
      EXPECT_LE(tree.radius_m, options.max_trunk_radius_m);
      EXPECT_TRUE(tree.x_m > 0.0 && tree.x_m < 80.0 && tree.y_m > 0.0 && tree.y_m < 40.0);
    }
  }
}

/// How many different trees a scan has an echo of.
std::size_t TreesIn(const Reading& reading, const std::vector<RoundOptions>& trees) {
  std::vector<bool> is_seen(trees.size(), false);
  const qwsm::LaserGeometry& geometry = reading.scan.geometry;
  for (std::size_t beam = 0; beam < reading.scan.size(); ++beam) {
    const auto range_m = static_cast<double>(reading.scan.ranges_m[beam]);
    if (StateOf(reading.scan.ranges_m[beam], geometry) != qwsm::BeamState::kHit) continue;
    const qwsm::Pose2 T_laser_beam{0.0, 0.0, geometry.Bearing(beam)};
    const Eigen::Vector2d p_world =
        reading.T_world_robot * geometry.T_robot_laser * T_laser_beam * Eigen::Vector2d(range_m, 0);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const double from_bark_m =
          (p_world - Eigen::Vector2d(trees[i].x_m, trees[i].y_m)).norm() - trees[i].radius_m;
      if (std::abs(from_bark_m) < 0.2) is_seen[i] = true;
    }
  }
  return static_cast<std::size_t>(std::ranges::count(is_seen, true));
}

TEST(Park, IsTheSparsePlaceOfThePaper) {
  for (int seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Simulation simulation(testing::Park(seed));
    int scans = 0;
    int with_few_trees = 0;
    int with_no_tree = 0;
    while (const std::optional<Reading> reading = simulation.Next()) {
      const std::size_t trees = TreesIn(*reading, simulation.scenery().rounds);
      ++scans;
      with_few_trees += trees <= 2 ? 1 : 0;
      with_no_tree += trees == 0 ? 1 : 0;
    }
    EXPECT_NEAR(scans, 800, 100);
    EXPECT_GE(with_few_trees, scans / 5) << "of " << scans;
    EXPECT_LE(with_no_tree, scans / 40) << "of " << scans;
  }
}

TEST(Park, IsDrivenOnceRoundClockwise) {
  Simulation simulation(testing::Park(1));
  const qwsm::Pose2 T_world_start = simulation.T_world_robot(0);
  EXPECT_GT(T_world_start.x_m, 70.0);
  EXPECT_LT(T_world_start.y_m, 10.0);
  const Eigen::Vector2d middle_m(40.0, 20.0);
  double round_rad = 0.0;
  Eigen::Vector2d before_m = T_world_start.translation_m() - middle_m;
  while (!simulation.is_over()) {
    simulation.Step();
    const Eigen::Vector2d now_m = simulation.T_world_robot(0).translation_m() - middle_m;
    round_rad +=
        std::atan2(before_m.x() * now_m.y() - before_m.y() * now_m.x(), before_m.dot(now_m));
    before_m = now_m;
  }
  EXPECT_NEAR(round_rad, -2.0 * std::numbers::pi, 0.3);
  const qwsm::Pose2 T_world_end = simulation.T_world_robot(0);
  EXPECT_LT((T_world_end.translation_m() - T_world_start.translation_m()).norm(), 8.0);
}

}  // namespace
}  // namespace sim
