// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What scans tell of other robots where maps might be one.
#include "service/team/atlas/teammate_sight.hpp"

#include <gtest/gtest.h>

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
  EXPECT_TRUE(SeesNobodyAt(RoomAround(), {2.0, 0.0}));
  EXPECT_TRUE(SeesNobodyAt(RoomAround(), {-1.0, 3.0}));
}

TEST(TeammateSight, TellsThatNobodyIsWhereTheRobotStandsItself) {
  EXPECT_TRUE(SeesNobodyAt(RoomWith(0.5F), {0.1, 0.1}));
}

TEST(TeammateSight, TellsNothingOfWhatIsHidden) {
  EXPECT_FALSE(SeesNobodyAt(RoomAround(), {6.0, 0.0}));
  EXPECT_FALSE(SeesNobodyAt(RoomWith(1.0F), {2.0, 0.0}));
}

TEST(TeammateSight, TellsNothingWhereSomethingStands) {
  EXPECT_FALSE(SeesNobodyAt(RoomWith(2.0F), {2.1, 0.0}));
  const float taken_out = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(SeesNobodyAt(RoomWith(taken_out), {2.0, 0.0}));
}

TEST(TeammateSight, LooksFromTheLaser) {
  LaserScan scan = RoomWith(1.0F);
  scan.geometry.T_robot_laser = {.x_m = 0.0, .y_m = 0.0, .theta_rad = std::numbers::pi};
  EXPECT_TRUE(SeesNobodyAt(scan, {2.0, 0.0}));
  EXPECT_FALSE(SeesNobodyAt(scan, {-2.0, 0.0}));
}

/// Two robots that cross a room, one from scan to scan as far as the other one.
class CrossingRobots : public testing::Test {
 protected:
  static ScanMap MapOf(Timestamp first, Timestamp period, double x_m) {
    ScanMap map;
    for (int i = 0; i < 3; ++i) {
      const LaserScan scan = RoomAround(first + i * period);
      map.Insert(scan,
                 ToPoints(scan),
                 UncertainPose2::WithSigmas({.x_m = x_m, .y_m = 0.4 * i}, 0.01, 0.001));
    }
    return map;
  }

  static int Unseen(const ScanMap& a, const ScanMap& b, const Pose2& T_a_b, int at_most = 100) {
    const std::array scans{std::vector<ScanId>{0, 1, 2}};
    return CountUnseen(
        {.map = a, .scans_of_robots = scans}, {.map = b, .scans_of_robots = scans}, T_a_b, at_most);
  }
};

TEST_F(CrossingRobots, AreMissedByEachScanThatTheOtherDroveMeanwhile) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap b = MapOf(500ms, 1s, 2.0);
  EXPECT_EQ(Unseen(a, b, {}), 4);  // All but the first of all and the last.
  EXPECT_EQ(Unseen(b, a, {}), 4);
  EXPECT_EQ(Unseen(a, b, {}, 3), 3);
}

TEST_F(CrossingRobots, AreNotMissedWhereTheyWereHidden) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap b = MapOf(500ms, 1s, 2.0);
  EXPECT_EQ(Unseen(a, b, {.x_m = 30.0, .y_m = 0.0}), 0);
}

TEST_F(CrossingRobots, AreNotMissedAtOtherTimes) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  EXPECT_EQ(Unseen(a, MapOf(1h, 1s, 2.0), {}), 0);
  const ScanMap of_one_that_stood = MapOf(-30s, 31s, 2.0);
  EXPECT_EQ(Unseen(a, of_one_that_stood, {}), 1);  // It was there as its own scan was taken.
}

TEST_F(CrossingRobots, AreNotMissedInEmptyMaps) {
  const ScanMap a = MapOf(0s, 1s, 0.0);
  const ScanMap empty;
  EXPECT_EQ(
      CountUnseen({.map = a, .scans_of_robots = {}}, {.map = empty, .scans_of_robots = {}}, {}, 4),
      0);
}

}  // namespace
}  // namespace qwsm::team
