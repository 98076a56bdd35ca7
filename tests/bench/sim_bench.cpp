// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a ray costs against the number of bodies, with trying every body as the baseline, and how
// much faster than real time robots are simulated.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "sim/simulation.hpp"
#include "tests/support/sim_scenarios.hpp"

namespace sim {
namespace {

constexpr double kRange_m = 20.0;
constexpr double kDensity_per_m2 = 0.02;  // Of trunks; the world grows with their number.

struct Forest {
  PhysicsWorld world;
  std::vector<RoundOptions> trunks;
  BodyId robot{};
  double extent_m = 0.0;

  explicit Forest(int count) : extent_m(std::sqrt(count / kDensity_per_m2)) {
    RandomEngine random(1);
    for (int i = 0; i < count; ++i) {
      trunks.push_back({.x_m = Uniform(random, 0.0, extent_m),
                        .y_m = Uniform(random, 0.0, extent_m),
                        .radius_m = Uniform(random, 0.12, 0.4)});
      world.AddFixed(Disc{trunks.back().radius_m}, {trunks.back().x_m, trunks.back().y_m, 0.0});
    }
    robot = world.AddDriven(Disc{0.01}, {0.5 * extent_m, 0.5 * extent_m, 0.0}, 1.0);
  }
};

void RayByTree(benchmark::State& state) {
  const Forest forest(static_cast<int>(state.range(0)));
  RandomEngine random(2);
  for (auto _ : state) {
    const Eigen::Vector2d from_m(Uniform(random, 0.0, forest.extent_m),
                                 Uniform(random, 0.0, forest.extent_m));
    const double direction_rad = Uniform(random, -std::numbers::pi, std::numbers::pi);
    benchmark::DoNotOptimize(forest.world.CastRay(from_m, direction_rad, kRange_m, forest.robot));
  }
}
BENCHMARK(RayByTree)->RangeMultiplier(10)->Range(10, 100000);

void RayByTryingAll(benchmark::State& state) {
  const Forest forest(static_cast<int>(state.range(0)));
  RandomEngine random(2);
  for (auto _ : state) {
    const Eigen::Vector2d from_m(Uniform(random, 0.0, forest.extent_m),
                                 Uniform(random, 0.0, forest.extent_m));
    const double direction_rad = Uniform(random, -std::numbers::pi, std::numbers::pi);
    const Eigen::Vector2d direction(std::cos(direction_rad), std::sin(direction_rad));
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const RoundOptions& trunk : forest.trunks) {
      const Eigen::Vector2d to_m = Eigen::Vector2d(trunk.x_m, trunk.y_m) - from_m;
      const double along_m = to_m.dot(direction);
      const double chord_m2 =
          trunk.radius_m * trunk.radius_m - (to_m.squaredNorm() - along_m * along_m);
      if (chord_m2 < 0.0 || along_m < 0.0) continue;
      nearest_m = std::min(nearest_m, along_m - std::sqrt(chord_m2));
    }
    benchmark::DoNotOptimize(nearest_m);
  }
}
BENCHMARK(RayByTryingAll)->RangeMultiplier(10)->Range(10, 100000);

/// Robots at 10 Hz with 361 beams in one office; the counter says how much faster than real time.
void OfficeWithRobots(benchmark::State& state) {
  ScenarioOptions scenario = testing::Drive(LayoutKind::kOffice, 1);
  const auto robots = static_cast<int>(state.range(0));
  scenario.duration_s = 20.0;
  scenario.layout.office.rooms_per_side = 16;
  scenario.layout.office.routes = robots;
  RobotOptions robot;
  robot.laser.beams = 361;
  scenario.robots.clear();
  for (int i = 0; i < robots; ++i) {
    robot.name = "robot " + std::to_string(i);
    scenario.robots.push_back(robot);
  }
  for (auto _ : state) {
    Simulation simulation(scenario);
    while (simulation.Next()) {
    }
  }
  state.counters["x_real_time"] =
      benchmark::Counter(scenario.duration_s, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(OfficeWithRobots)->Arg(1)->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sim
