// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a scan costs against the size of the map: the whole of Mapper::Process(), with search,
// match, covariance and insertion. The robot is put into another room of the building for every
// scan, so that no cache knows where it is; a counter compares with the smallest map of the run.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "qwsm/mapping/robot_tracker.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "tests/bench/rooms.hpp"

namespace qwsm::bench {
namespace {

constexpr std::size_t kBeams = 181;
constexpr std::size_t kPointsPerRoom = 600;

double Now_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// A map of the building in which every room was seen well.
ScanMap MapOf(const Building& building) {
  Random random(1);
  const Points points_m = building.Sampled(random);
  ScanMap map;
  for (std::size_t first = 0; first < points_m.size(); first += kPointsPerRoom) {
    MapAddition addition;
    for (std::size_t i = first; i < first + kPointsPerRoom; ++i) {
      addition.points.push_back({.p_map_m = points_m[i], .spacing_m = 0.03});
    }
    map.Add(std::move(addition));
  }
  return map;
}

double Quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// What Mapper::Process() does with a scan, in ms.
double TimeOfScan_ms(const Building& building,
                     Random& random,
                     ScanMap& map,
                     RobotTracker& tracker) {
  const Standpoint standpoint = AnyStandpoint(building, random);
  const Pose2 T_odom_robot{0.05, 0.01, 0.01};
  UncertainPose2 start{.T_a_b = standpoint.T_map_robot() * T_odom_robot.Inverse()};
  start.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal();
  tracker.PlaceAt(start, Pose2{});
  const Observation observation{.scan = ScanFrom(standpoint, kBeams, random),
                                .T_odom_robot = T_odom_robot};
  const double before_ms = Now_ms();
  const MappingStep step = tracker.Track(map, observation).step;
  if (step.relevant)
    map.Insert(step.relevant_scan, ToPoints(step.relevant_scan), step.map_relevant);
  return Now_ms() - before_ms;
}

void ScanAgainstMapSize(benchmark::State& state) {
  const Building building(static_cast<std::size_t>(state.range(0)), kPointsPerRoom);
  ScanMap map = MapOf(building);
  RobotTracker tracker;
  Random random(2);
  std::vector<double> times_ms;
  for (auto _ : state) {
    times_ms.push_back(TimeOfScan_ms(building, random, map, tracker));
    state.SetIterationTime(times_ms.back() * 1e-3);
  }
  static double smallest_map_ms = 0.0;
  const double median_ms = Quantile(times_ms, 0.5);
  if (smallest_map_ms == 0.0) smallest_map_ms = median_ms;
  state.counters["median_ms"] = median_ms;
  state.counters["p99_ms"] = Quantile(times_ms, 0.99);
  state.counters["over_smallest"] = median_ms / smallest_map_ms;
  state.counters["points"] = static_cast<double>(map.surfaces().quadtree().size());
  state.counters["bytes_per_point"] = static_cast<double>(map.surfaces().bytes()) /
                                      static_cast<double>(map.surfaces().quadtree().size());
}
BENCHMARK(ScanAgainstMapSize)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(500)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(4'000'000)
    ->Arg(10'000'000);

}  // namespace
}  // namespace qwsm::bench
