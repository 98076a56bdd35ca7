// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/laser.hpp"

namespace sim {
namespace {

using namespace std::chrono_literals;

/// A robot that looks at a long wall 5 m ahead of it.
class LaserTest : public ::testing::Test {
 protected:
  LaserTest() : robot_(world_.AddDriven(Rectangle{0.5, 0.5}, {}, 30.0)) {
    world_.AddFixed(Rectangle{1.0, 200.0}, {5.5, 0.0, 0.0});
  }

  qwsm::LaserScan Scan(const LaserOptions& options, std::uint64_t seed = 1) {
    Laser laser(options, seed);
    laser.Begin(world_, robot_, 0s);
    return laser.Take().value();
  }

  /// Readings of many scans of the wall straight ahead.
  std::vector<double> ReadingsAhead(const LaserOptions& options, int scans) {
    Laser laser(options, 7);
    std::vector<double> readings_m;
    for (int i = 0; i < scans; ++i) {
      laser.Begin(world_, robot_, i * 1s);
      readings_m.push_back(static_cast<double>(laser.Take().value().ranges_m.front()));
    }
    return readings_m;
  }

  PhysicsWorld world_;
  BodyId robot_;
};

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double Sigma(const std::vector<double>& values) {
  const double mean = Mean(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

TEST_F(LaserTest, BeamsRunFromRightToLeftOverTheFieldOfView) {
  const qwsm::LaserScan scan = Scan({.range_sigma_m = 0.0});
  ASSERT_EQ(scan.size(), 181U);
  EXPECT_NEAR(scan.geometry.Bearing(0), -0.5 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(scan.geometry.Bearing(180), 0.5 * std::numbers::pi, 1e-5);
  for (std::size_t beam = 20; beam < 161; ++beam) {
    EXPECT_NEAR(scan.ranges_m[beam], 5.0 / std::cos(scan.geometry.Bearing(beam)), 1e-4) << beam;
  }
}

TEST_F(LaserTest, BeamsThatMeetNothingAreMisses) {
  const qwsm::LaserScan scan = Scan({.useful_range_m = 10.0});
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const bool reaches = 5.0 / std::cos(scan.geometry.Bearing(beam)) < 10.0;
    const bool is_ahead = std::abs(scan.geometry.Bearing(beam)) < 1.5;
    EXPECT_EQ(StateOf(scan.ranges_m[beam], scan.geometry),
              reaches && is_ahead ? qwsm::BeamState::kHit : qwsm::BeamState::kMiss)
        << beam;
  }
}

TEST_F(LaserTest, MountingMovesTheBeams) {
  const qwsm::LaserScan scan =
      Scan({.beams = 1, .mount_x_m = 0.3, .mount_heading_rad = 0.5, .range_sigma_m = 0.0});
  EXPECT_NEAR(scan.ranges_m[0], (5.0 - 0.3) / std::cos(0.5), 1e-4);
  EXPECT_EQ(scan.geometry.T_robot_laser, (qwsm::Pose2{0.3, 0.0, 0.5}));
}

TEST_F(LaserTest, RangeNoiseHasItsSigmaAndNoBias) {
  constexpr int kScans = 20000;
  const std::vector<double> readings_m = ReadingsAhead({.beams = 1, .range_sigma_m = 0.02}, kScans);
  EXPECT_NEAR(Mean(readings_m), 5.0, 4.0 * 0.02 / std::sqrt(kScans));
  EXPECT_NEAR(Sigma(readings_m), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * kScans));
}

TEST_F(LaserTest, RelativeNoiseAddsInSquares) {
  constexpr int kScans = 20000;
  const std::vector<double> readings_m =
      ReadingsAhead({.beams = 1, .range_sigma_m = 0.03, .range_sigma_relative = 0.008}, kScans);
  EXPECT_NEAR(Sigma(readings_m), 0.05, 4.0 * 0.05 / std::sqrt(2.0 * kScans));
}

TEST_F(LaserTest, BearingNoiseSpreadsReadingsOfASlantedWall) {
  constexpr int kScans = 20000;
  const double bearing_rad = 0.8;
  const LaserOptions options{.beams = 1,
                             .mount_heading_rad = bearing_rad,
                             .range_sigma_m = 0.0,
                             .bearing_sigma_rad = 0.002};
  const double range_m = 5.0 / std::cos(bearing_rad);
  const double sigma_m = range_m * std::tan(bearing_rad) * 0.002;
  EXPECT_NEAR(
      Sigma(ReadingsAhead(options, kScans)), sigma_m, 5.0 * sigma_m / std::sqrt(2.0 * kScans));
}

TEST_F(LaserTest, DropoutsAreMissesInTheirShare) {
  constexpr int kScans = 20000;
  const std::vector<double> readings_m =
      ReadingsAhead({.beams = 1, .dropout_probability = 0.1}, kScans);
  const auto lost = std::count_if(
      readings_m.begin(), readings_m.end(), [](double reading_m) { return reading_m > 80.0; });
  EXPECT_NEAR(static_cast<double>(lost) / kScans, 0.1, 4.0 * std::sqrt(0.1 * 0.9 / kScans));
}

TEST_F(LaserTest, RoundsToItsStep) {
  for (const double reading_m :
       ReadingsAhead({.beams = 1, .range_sigma_m = 0.02, .range_step_m = 0.01}, 100)) {
    EXPECT_NEAR(reading_m, 0.01 * std::round(reading_m / 0.01), 1e-6);
  }
}

TEST_F(LaserTest, SweepOfAMovingRobotSkewsTheScan) {
  const LaserOptions options{
      .beams = 11, .field_of_view_rad = 0.0, .sweep_s = 0.1, .range_sigma_m = 0};
  Laser laser(options, 1);
  laser.Begin(world_, robot_, 0s);
  EXPECT_FALSE(laser.Take().has_value());
  // 2 m/s towards the wall from the first step on.
  world_.Apply(robot_, {.force_n = {30.0 * 2.0 / 0.01, 0.0}, .torque_nm = 0.0});
  for (int step = 1; step <= 10; ++step) {
    world_.Step(10ms);
    laser.Continue(world_, robot_, step * 10ms);
  }
  const auto scan = laser.Take();
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(scan->stamp, 0s);
  for (std::size_t beam = 0; beam < scan->size(); ++beam) {
    EXPECT_NEAR(scan->ranges_m[beam], 5.0 - 2.0 * 0.01 * static_cast<double>(beam), 1e-4);
  }
}

}  // namespace
}  // namespace sim
