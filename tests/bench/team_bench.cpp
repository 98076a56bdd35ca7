// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How long a match waits for the map while others extend it, beside what a lock around the map
// would cost; and what the journal costs. Times of the same run are to be compared, nothing else.
#include <benchmark/benchmark.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <thread>
#include <vector>

#include "qwsm/mapping/robot_tracker.hpp"
#include "service/io/journal/journal_file.hpp"
#include "service/io/journal/scan_codec.hpp"
#include "service/team/map/team_map.hpp"
#include "service/team/session/latency_histogram.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

using std::chrono::steady_clock;

constexpr int kScans = 120;

TeamScan ScanOf(std::uint64_t sequence) {
  const int scan = static_cast<int>(sequence % kScans);
  return {.key = {.service = "base", .robot = "robot1", .sequence = sequence},
          .scan = test::ObservationInRoom(scan).scan,
          .map_robot = {.T_a_b = test::PoseInRoom(scan)},
          .T_odom_robot = {}};
}

/// Every point is stored, so that every insertion has much to do.
ScanMapOptions Options() {
  ScanMapOptions options;
  options.insertion = InsertionRule::kEveryPoint;
  return options;
}

/// The yardstick: one map and one lock.
class LockedMap {
 public:
  explicit LockedMap(const ScanMapOptions& options)
      : contents_{.map = ScanMap(options), .epoch = 0} {}
  struct View {
    std::shared_lock<std::shared_mutex> lock;
    const TeamMap::Contents* contents;
    const TeamMap::Contents* operator->() const { return contents; }
  };
  View Read() const { return {std::shared_lock(mutex_), &contents_}; }
  void Insert(const TeamScan& scan, std::span<const ScanPoint> points) {
    const std::lock_guard lock(mutex_);
    contents_.map.Insert(scan.scan, points, scan.map_robot);
  }

 private:
  mutable std::shared_mutex mutex_;
  TeamMap::Contents contents_;
};

/// Matches while another thread inserts scan after scan.
template <class Map>
void BM_MatchWhileInserting(benchmark::State& state) {
  Map map(Options());
  std::uint64_t sequence = 0;
  for (; sequence < kScans; ++sequence) {
    const TeamScan scan = ScanOf(sequence);
    map.Insert(scan, ToPoints(scan.scan));
  }
  std::atomic<std::uint64_t> inserted = 0;
  std::jthread writer([&](const std::stop_token& stop) {
    for (std::uint64_t i = sequence; !stop.stop_requested() && i < 20 * kScans; ++i) {
      const TeamScan scan = ScanOf(i);
      map.Insert(scan, ToPoints(scan.scan));
      ++inserted;
    }
  });
  LatencyHistogram waiting;
  LatencyHistogram matching;
  int at = 0;
  for (auto _ : state) {
    RobotTracker tracker;
    tracker.PlaceAt({.T_a_b = test::PoseInRoom(at)});
    const Observation observation = test::ObservationInRoom(at);
    at = (at + 7) % kScans;
    const auto asked = steady_clock::now();
    const auto view = map.Read();
    const auto begun = steady_clock::now();
    benchmark::DoNotOptimize(tracker.Track(view->map, observation));
    waiting.Add(begun - asked);
    matching.Add(steady_clock::now() - begun);
  }
  writer.request_stop();
  const auto us = [](std::chrono::nanoseconds time) {
    return static_cast<double>(time.count()) / 1e3;
  };
  state.counters["wait_p99_us"] = us(waiting.Quantile(0.99));
  state.counters["wait_longest_us"] = us(waiting.longest());
  state.counters["match_median_us"] = us(matching.Quantile(0.5));
  state.counters["inserted"] = static_cast<double>(inserted.load());
}
BENCHMARK_TEMPLATE(BM_MatchWhileInserting, TeamMap)->UseRealTime();
BENCHMARK_TEMPLATE(BM_MatchWhileInserting, LockedMap)->UseRealTime();

/// One relevant scan more in the map; the team's map does it twice.
template <class Map>
void BM_Insert(benchmark::State& state) {
  Map map{ScanMapOptions()};
  std::uint64_t sequence = 0;
  for (auto _ : state) {
    const TeamScan scan = ScanOf(sequence++);
    map.Insert(scan, ToPoints(scan.scan));
  }
}
BENCHMARK_TEMPLATE(BM_Insert, TeamMap);
BENCHMARK_TEMPLATE(BM_Insert, LockedMap);

/// Relevant scans on their way to the disk, so many at a time; per second, beside which a robot has
/// one or two.
void BM_Journal(benchmark::State& state) {
  const test::TemporaryFolder folder;
  io::JournalFile journal =
      io::JournalFile::Continue(folder.path() / "team.journal", io::kScanJournal, "base");
  std::uint64_t sequence = 0;
  for (auto _ : state) {
    std::vector<io::JournalEntry> entries;
    for (std::int64_t i = 0; i < state.range(0); ++i) {
      const TeamScan scan = ScanOf(++sequence);
      entries.push_back(
          {.service = scan.key.service,
           .robot = scan.key.robot,
           .sequence = scan.key.sequence,
           .stamp = scan.scan.stamp,
           .contents = io::EncodeScan({.relevant = {.scan = scan.scan, .map_robot = scan.map_robot},
                                       .T_odom_robot = {}})});
    }
    journal.Append(entries);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_Journal)->Arg(1)->Arg(16)->Arg(64)->UseRealTime();

}  // namespace
}  // namespace qwsm::team
