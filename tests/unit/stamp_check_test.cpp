// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/stamp_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace qwsm {
namespace {

/// The heading of a robot that looks around.
double HeadingAt(double time_s) {
  return 0.9 * std::sin(0.9 * time_s) + 0.4 * std::sin(2.3 * time_s);
}

/// What a laser sees in the middle of a room of 9 m by 6 m with a pillar.
LaserScan ScanAt(double heading_rad) {
  constexpr int kBeams = 181;
  LaserScan scan{.stamp = {},
                 .geometry = {.first_bearing_rad = -1.5707964F,
                              .bearing_step_rad = std::numbers::pi_v<float> / (kBeams - 1),
                              .range_min_m = 0.0F,
                              .range_max_m = 30.0F,
                              .T_robot_laser = {}},
                 .ranges_m = {}};
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double bearing_rad = heading_rad + scan.geometry.Bearing(i);
    const double to_side_m = 5.0 / std::max(1e-9, std::cos(bearing_rad));
    const double to_back_m = 4.0 / std::max(1e-9, -std::cos(bearing_rad));
    const double to_wall_m = 3.0 / std::max(1e-9, std::abs(std::sin(bearing_rad)));
    const bool is_pillar = std::abs(NormalizeAngle(bearing_rad - 0.4)) < 0.1;
    const double range_m = is_pillar ? 2.0 : std::min({to_side_m, to_back_m, to_wall_m});
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

/// What is found of a minute in which scans bear stamps that are so much too late.
std::optional<double> OffsetFoundWith(double late_s) {
  StampCheck check;
  for (int i = 0; i < 600; ++i) {
    const double time_s = 0.1 * i;
    LaserScan scan = ScanAt(HeadingAt(time_s - late_s));
    scan.stamp = std::chrono::milliseconds(100) * i;
    check.Add(scan, Pose2{.theta_rad = HeadingAt(time_s)});
  }
  return check.offset_s();
}

TEST(StampCheck, FindsByHowMuchStampsDiffer) {
  for (const double late_s : {0.31, -0.2, 0.08, 0.7}) {
    const std::optional<double> found_s = OffsetFoundWith(late_s);
    ASSERT_TRUE(found_s) << late_s;
    EXPECT_NEAR(*found_s, -late_s, 0.02) << late_s;
  }
}

TEST(StampCheck, SaysNothingWhereTheyFit) {
  EXPECT_FALSE(OffsetFoundWith(0.0));
  EXPECT_FALSE(OffsetFoundWith(0.02));
}

TEST(StampCheck, SaysNothingOfOneJumpOfOdometry) {
  for (const double time_of_jump_s : {4.0, 5.0, 8.0, 20.0}) {
    StampCheck check;
    for (int i = 0; i < 600; ++i) {
      const double time_s = 0.1 * i;
      LaserScan scan = ScanAt(HeadingAt(time_s));
      scan.stamp = std::chrono::milliseconds(100) * i;
      const double jump_rad = time_s > time_of_jump_s ? 1.5 : 0.0;
      check.Add(scan, Pose2{.theta_rad = HeadingAt(time_s) + jump_rad});
    }
    EXPECT_FALSE(check.offset_s()) << time_of_jump_s;
  }
}

TEST(StampCheck, LooksNoFurtherThanAScanHasBeams) {
  StampCheck check;
  for (int i = 0; i < 20; ++i) {
    LaserScan scan = ScanAt(0.0);
    scan.geometry.bearing_step_rad = 1e-9F;  // 800 million beams to either side.
    scan.stamp = std::chrono::milliseconds(100) * i;
    check.Add(scan, Pose2{});
  }
  EXPECT_FALSE(check.offset_s());
}

// A laser of 24 Hz: of the first hundred scans three have two seconds before and behind them.
TEST(StampCheck, SaysNothingByAFewScans) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise_m(0.0F, 0.02F);
    StampCheck check;
    for (int i = 0; i < 110; ++i) {
      const Timestamp stamp = std::chrono::microseconds(41667) * i;
      const double time_s = Seconds(stamp);
      const double heading_rad = 2.0 * time_s + 0.3 * std::sin(0.7 * time_s + seed);
      LaserScan scan = ScanAt(heading_rad);
      scan.stamp = stamp;
      for (float& range_m : scan.ranges_m) range_m += noise_m(random);
      check.Add(scan, Pose2{.theta_rad = NormalizeAngle(heading_rad)});
    }
    EXPECT_FALSE(check.offset_s()) << seed;
  }
}

TEST(StampCheck, SaysNothingOfARobotThatGoesStraight) {
  StampCheck check;
  for (int i = 0; i < 600; ++i) {
    LaserScan scan = ScanAt(0.0);
    scan.stamp = std::chrono::milliseconds(100) * i;
    check.Add(scan, Pose2{});
  }
  EXPECT_FALSE(check.offset_s());
}

}  // namespace
}  // namespace qwsm
