// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws of a map that is read and extended by many at once.
#include "service/team/map/team_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/mapping/robot_tracker.hpp"
#include "service/io/maps/map_file.hpp"
#include "service/team/session/worker_pool.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

TeamScan ScanOf(const std::string& robot, int scan) {
  const Observation observation = test::ObservationInRoom(scan);
  return {
      .key = {.service = "base", .robot = robot, .sequence = static_cast<std::uint64_t>(scan) + 1},
      .scan = observation.scan,
      .map_robot = {.T_a_b = test::PoseInRoom(scan)},
      .T_odom_robot = observation.T_odom_robot};
}

std::vector<TeamScan> ScansOfTeam() {
  std::vector<TeamScan> scans;
  for (int scan = 0; scan < 40; ++scan) scans.push_back(ScanOf("robot1", 3 * scan));
  for (int scan = 0; scan < 40; ++scan) scans.push_back(ScanOf("robot2", 3 * scan + 1));
  return scans;
}

void InsertAll(TeamMap& map, const std::vector<TeamScan>& scans) {
  for (const TeamScan& scan : scans) map.Insert(scan, ToPoints(scan.scan));
}

TEST(TeamMap, IsTheMapThatOneRobotAloneWouldHaveMade) {
  TeamMap team;
  ScanMap alone;
  for (const TeamScan& scan : ScansOfTeam()) {
    team.Insert(scan, ToPoints(scan.scan));
    alone.Insert(scan.scan, ToPoints(scan.scan), scan.map_robot);
    ASSERT_EQ(io::EncodeMap(team.Read()->map), io::EncodeMap(alone));
  }
}

TEST(TeamMap, TakesEveryScanOnceAndDrawsTheSameInAnyOrder) {
  std::vector<TeamScan> scans = ScansOfTeam();
  TeamMap ordered;
  InsertAll(ordered, scans);
  const OccupancyGridResult expected = RenderOccupancyGrid(ordered.Read()->map.scans());
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    std::vector<TeamScan> repeated = scans;
    repeated.insert(repeated.end(), scans.begin(), scans.end());
    std::ranges::shuffle(repeated, std::mt19937(seed));
    TeamMap map;
    InsertAll(map, repeated);
    const TeamMap::State::View view = map.Read();
    EXPECT_EQ(view->map.scans().size(), scans.size());
    EXPECT_EQ(map.CountOf("robot1"), 40U);
    EXPECT_EQ(map.CountOf("robot2"), 40U);
    EXPECT_EQ(map.CountOf("robot3"), 0U);
    EXPECT_EQ(map.LastOf("robot1")->key, scans[39].key);
    const OccupancyGridResult grid = RenderOccupancyGrid(view->map.scans());
    EXPECT_EQ(grid.grid.origin_map_m, expected.grid.origin_map_m);
    EXPECT_EQ(grid.grid.cells, expected.grid.cells);
  }
}

/// The places of all stored points.
std::multiset<std::pair<double, double>> PointsOf(const ScanMap& map) {
  std::multiset<std::pair<double, double>> points;
  map.surfaces().quadtree().ForEach([&](PointId, const Eigen::Vector2d& p_m) {
    points.insert({p_m.x(), p_m.y()});
  });
  return points;
}

TEST(TeamMap, StoresTheSamePointsInAnyOrderWhereEveryPointIsStored) {
  ScanMapOptions options;
  options.insertion = InsertionRule::kEveryPoint;
  std::vector<TeamScan> scans = ScansOfTeam();
  TeamMap ordered(options);
  InsertAll(ordered, scans);
  std::ranges::shuffle(scans, std::mt19937(7));
  TeamMap shuffled(options);
  InsertAll(shuffled, scans);
  EXPECT_EQ(PointsOf(shuffled.Read()->map), PointsOf(ordered.Read()->map));
}

TEST(TeamMap, RemembersWhereEachRobotWasLast) {
  TeamMap map;
  InsertAll(map, ScansOfTeam());
  EXPECT_EQ(map.LastOf("robot2")->map_robot.T_a_b, test::PoseInRoom(118));
  EXPECT_FALSE(map.LastOf("robot3").has_value());
  EXPECT_EQ(map.LastSequence("base", "robot1"), 118U);
  EXPECT_EQ(map.LastSequence("other", "robot1"), 0U);
}

TEST(TeamMap, ViewsStayAsTheyAreWhileTheMapGrows) {
  TeamMap map;
  const std::vector<TeamScan> scans = ScansOfTeam();
  map.Insert(scans[0], ToPoints(scans[0].scan));
  const TeamMap::State::View before = map.Read();
  map.Insert(scans[1], ToPoints(scans[1].scan));  // Does not wait for the view.
  EXPECT_EQ(before->map.scans().size(), 1U);
  EXPECT_EQ(map.Read()->map.scans().size(), 2U);
}

TEST(TeamMap, IsMatchedAgainstInParallelWhileItIsExtended) {
  TeamMap map;
  const std::vector<TeamScan> scans = ScansOfTeam();
  map.Insert(scans[0], ToPoints(scans[0].scan));
  std::atomic<bool> done = false;
  std::atomic<int> bad_matches = 0;
  std::vector<std::jthread> readers;
  for (int reader = 0; reader < 3; ++reader) {
    readers.emplace_back([&, reader] {
      int at = reader;
      for (int lap = 0; !done || lap < 5; ++lap) {
        RobotTracker tracker;
        tracker.PlaceAt({.T_a_b = test::PoseInRoom(at)});
        const Observation observation = test::ObservationInRoom(at);
        const MappingStep step = tracker.Track(map.Read()->map, observation).step;
        const Pose2 error = test::PoseInRoom(at).Inverse() * step.map_robot.T_a_b;
        if (error.translation_m().norm() > 0.2) ++bad_matches;
        at = (at + 7) % 120;
      }
    });
  }
  std::vector<std::jthread> writers;
  for (std::size_t writer = 0; writer < 2; ++writer) {
    writers.emplace_back([&, writer] {
      for (std::size_t i = writer; i < scans.size(); i += 2) {
        map.Insert(scans[i], ToPoints(scans[i].scan));
        const std::size_t before = map.Read()->map.scans().size();
        EXPECT_GE(before, i / 2);  // At least what this writer wrote.
      }
    });
  }
  writers.clear();
  done = true;
  readers.clear();
  EXPECT_EQ(map.Read()->map.scans().size(), scans.size());
  EXPECT_EQ(bad_matches, 0);
}

/// Counts up; two pieces must never run at once, nor out of order.
class CountingLane final : public Lane {
 public:
  explicit CountingLane(int pieces) : left_(pieces) {}
  std::optional<Time> ReadyAt() const override {
    return left_ > 0 ? std::optional(Time{}) : std::nullopt;
  }
  void RunOne() override {
    if (running_.exchange(true)) overlaps_ = true;
    ++count_;  // Not atomic: a race here is one the sanitizer finds.
    --left_;
    running_ = false;
  }
  int count() const { return count_; }
  bool overlaps() const { return overlaps_; }

 private:
  std::atomic<int> left_;
  int count_ = 0;
  std::atomic<bool> running_ = false;
  std::atomic<bool> overlaps_ = false;
};

TEST(WorkerPool, WorksOnEachLaneInOrderAndOnAllToTheEnd) {
  std::vector<std::shared_ptr<CountingLane>> lanes;
  WorkerPool pool(4);
  for (int lane = 0; lane < 10; ++lane) {
    lanes.push_back(std::make_shared<CountingLane>(200));
    pool.Add(lanes.back());
  }
  pool.WaitUntilIdle();
  pool.Stop();
  for (const auto& lane : lanes) {
    EXPECT_EQ(lane->count(), 200);
    EXPECT_FALSE(lane->overlaps());
  }
}

}  // namespace
}  // namespace qwsm::team
