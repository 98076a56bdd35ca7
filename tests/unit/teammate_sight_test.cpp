// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What scans tell of other robots where maps might be one.
#include "service/team/atlas/teammate_sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "qwsm/geometry/angle.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

constexpr float kWall_m = 5.0F;
constexpr float kTakenOut = std::numeric_limits<float>::quiet_NaN();

/// From the middle of a round room.
LaserScan RoomAround(Timestamp stamp = {}) {
  LaserScan scan;
  scan.stamp = stamp;
  scan.geometry = {.first_bearing_rad = -std::numbers::pi_v<float>,
                   .bearing_step_rad = std::numbers::pi_v<float> / 180.0F,
                   .range_min_m = 0.0F,
                   .range_max_m = 20.0F,
                   .T_robot_laser = {}};
  scan.ranges_m.assign(360, kWall_m);
  return scan;
}

/// The same with other readings ahead, a body wide.
LaserScan RoomWith(float ahead_m) {
  LaserScan scan = RoomAround();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (std::abs(NormalizeAngle(scan.geometry.Bearing(beam))) < 0.2) scan.ranges_m[beam] = ahead_m;
  }
  return scan;
}

TEST(TeammateSight, TellsThatNobodyIsWhereItSeesFarther) {
  EXPECT_EQ(LookAt(RoomAround(), {2.0, 0.0}), Sight::kNobody);
  EXPECT_EQ(LookAt(RoomAround(), {-1.0, 3.0}), Sight::kNobody);
}

TEST(TeammateSight, TellsThatNobodyIsWhereTheRobotStandsItself) {
  EXPECT_EQ(LookAt(RoomWith(0.5F), {0.1, 0.1}), Sight::kNobody);
}

TEST(TeammateSight, TellsNothingOfWhatIsHidden) {
  EXPECT_EQ(LookAt(RoomAround(), {6.0, 0.0}), Sight::kNothing);
  EXPECT_EQ(LookAt(RoomWith(1.0F), {2.0, 0.0}), Sight::kNothing);
}

TEST(TeammateSight, TellsOfSomebodyWhereSomethingStandsFree) {
  EXPECT_EQ(LookAt(RoomWith(2.0F), {2.1, 0.0}), Sight::kSomebody);
  EXPECT_EQ(LookAt(RoomWith(kTakenOut), {2.0, 0.0}), Sight::kSomebody);
}

TEST(TeammateSight, TellsNothingOfAWall) {
  EXPECT_EQ(LookAt(RoomAround(), {5.0, 0.0}), Sight::kNothing);
}

// Some lasers call that invalid.
TEST(TeammateSight, TellsNothingWhereNothingIsMeasured) {
  LaserScan scan = RoomAround();
  std::ranges::fill(scan.ranges_m, kTakenOut);
  EXPECT_EQ(LookAt(scan, {2.0, 0.0}), Sight::kNothing);
  std::ranges::fill(scan.ranges_m, 0.0F);
  EXPECT_EQ(LookAt(scan, {2.0, 0.0}), Sight::kNothing);
}

TEST(TeammateSight, LooksFromTheLaser) {
  LaserScan scan = RoomWith(1.0F);
  scan.geometry.T_robot_laser = {.x_m = 0.0, .y_m = 0.0, .theta_rad = std::numbers::pi};
  EXPECT_EQ(LookAt(scan, {2.0, 0.0}), Sight::kNobody);
  EXPECT_EQ(LookAt(scan, {-2.0, 0.0}), Sight::kNothing);
  EXPECT_EQ(LookAt(scan, {-1.1, 0.0}), Sight::kSomebody);
}

/// Two robots that cross a room, one from scan to scan as far as the other one.
class CrossingRobots : public testing::Test {
 protected:
  static constexpr double kBeside_m = 2.0;

  /// @param ahead_m what is read ahead, where the other one drives.
  static ScanMap MapOf(Timestamp first, Timestamp period, double x_m, float ahead_m = kWall_m) {
    ScanMap map;
    for (int i = 0; i < 3; ++i) {
      LaserScan scan = RoomWith(ahead_m);
      scan.stamp = first + i * period;
      map.Insert(scan,
                 ToPoints(scan),
                 UncertainPose2::WithSigmas({.x_m = x_m, .y_m = 0.4 * i}, 0.01, 0.001));
    }
    return map;
  }

  static SightCounts Sights(const ScanMap& a,
                            const ScanMap& b,
                            const Pose2& T_a_b = {},
                            int at_most_nobody = 100) {
    const std::array scans{std::vector<ScanId>{0, 1, 2}};
    return CountSights({.map = a, .scans_of_robots = scans},
                       {.map = b, .scans_of_robots = scans},
                       T_a_b,
                       at_most_nobody);
  }
};

TEST_F(CrossingRobots, AreMissedByEachScanThatTheOtherDroveMeanwhile) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap b = MapOf(500ms, 1s, kBeside_m);
  const SightCounts all_but_the_first_and_the_last{.somebody = 0, .nobody = 4};
  EXPECT_EQ(Sights(a, b), all_but_the_first_and_the_last);
  EXPECT_EQ(Sights(b, a), all_but_the_first_and_the_last);
  EXPECT_EQ(Sights(a, b, {}, 3).nobody, 3);
}

TEST_F(CrossingRobots, AreSeenByOneThatLooksTheirWay) {
  const ScanMap a = MapOf(0s, 1s, 0.0, 1.8F);
  const ScanMap b = MapOf(0s, 1s, kBeside_m);
  const SightCounts seen_from_the_second_scan_on{.somebody = 2, .nobody = 2};
  EXPECT_EQ(Sights(a, b), seen_from_the_second_scan_on);
  EXPECT_EQ(Sights(b, a), seen_from_the_second_scan_on);
}

TEST_F(CrossingRobots, AreNotMissedWhereTheyWereHidden) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap b = MapOf(500ms, 1s, kBeside_m);
  EXPECT_EQ(Sights(a, b, {.x_m = 30.0, .y_m = 0.0}), SightCounts{});
}

TEST_F(CrossingRobots, AreNotMissedAtOtherTimes) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  EXPECT_EQ(Sights(a, MapOf(1h, 1s, kBeside_m)), SightCounts{});
  const ScanMap of_one_that_stood = MapOf(-30s, 31s, kBeside_m);
  EXPECT_EQ(Sights(a, of_one_that_stood).nobody, 1);  // It was there as its own scan was taken.
}

TEST_F(CrossingRobots, AreNotMissedInEmptyMaps) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap empty;
  EXPECT_EQ(
      CountSights({.map = a, .scans_of_robots = {}}, {.map = empty, .scans_of_robots = {}}, {}, 4),
      SightCounts{});
}

}  // namespace
}  // namespace qwsm::team
