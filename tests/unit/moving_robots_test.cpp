// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/moving_robots.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kAhead = 90;  // The beam.
constexpr double kRadius_m = 0.7;

/// Something 0.35 m across that stands ahead, before a round wall.
LaserScan ScanOfBodyAhead(double range_m, Timestamp stamp) {
  LaserScan scan{.stamp = stamp,
                 .geometry = {.first_bearing_rad = -1.570796F,
                              .bearing_step_rad = 0.01745329F,
                              .range_min_m = 0.1F,
                              .range_max_m = 20.0F,
                              .T_robot_laser = {}},
                 .ranges_m = std::vector<float>(181, 9.0F)};
  for (std::size_t beam = kAhead - 2; beam <= kAhead + 2; ++beam) {
    scan.ranges_m[beam] = static_cast<float>(range_m);
  }
  return scan;
}

bool IsHidden(const LaserScan& scan, std::size_t beam) { return std::isnan(scan.ranges_m[beam]); }

TEST(HideMovingRobots, HidesABodyUntilItIsSeenToStand) {
  MovingBodies bodies;
  for (Timestamp stamp{}; stamp < 3s; stamp += 100ms) {
    SCOPED_TRACE(stamp.count());
    LaserScan scan = ScanOfBodyAhead(5.0, stamp);
    HideMovingRobots(kRadius_m, {}, bodies, scan);
    // By one scan nobody knows who follows whom.
    EXPECT_EQ(IsHidden(scan, kAhead), stamp > 0s && stamp < 1100ms);
    EXPECT_FALSE(IsHidden(scan, 0));
  }
}

TEST(HideMovingRobots, HidesWhoComesAlongAllTheWay) {
  MovingBodies bodies;
  for (int i = 1; i < 50; ++i) {
    SCOPED_TRACE(i);
    LaserScan scan = ScanOfBodyAhead(7.0 - 0.1 * i, i * 100ms);
    HideMovingRobots(kRadius_m, {}, bodies, scan);
    EXPECT_EQ(IsHidden(scan, kAhead), i > 1);
  }
}

}  // namespace
}  // namespace qwsm::team
