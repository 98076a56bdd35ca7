// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/deskew.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "qwsm/match_scans.hpp"
#include "tests/support/world.hpp"

namespace qwsm {
namespace {

constexpr std::size_t kBeams = 361;
constexpr std::chrono::milliseconds kSweep(100);

/// A room of 8 x 6 m with a box in a corner.
test::World Room() {
  return {.walls = {{{-4, -3}, {4, -3}},
                    {{4, -3}, {4, 3}},
                    {{4, 3}, {-4, 3}},
                    {{-4, 3}, {-4, -3}},
                    {{2, 1}, {2, 3}},
                    {{2, 1}, {4, 1}}},
          .columns = {}};
}

/// Along a circle, at an even speed.
Pose2 Part(const Pose2& motion, double share) {
  constexpr int kPieces = 64;
  const double turn_rad = motion.theta_rad / kPieces;
  const Pose2 turned{.theta_rad = 0.5 * (kPieces - 1) * turn_rad};
  // The pieces lie on a chord: as long as that is, they go.
  double chord = 0.0;
  for (int i = 0; i < kPieces; ++i) chord += std::cos((i - 0.5 * (kPieces - 1)) * turn_rad);
  const Eigen::Vector2d piece_m = turned.Inverse() * motion.translation_m() / chord;
  Pose2 part;
  const double pieces = share * kPieces;
  for (int i = 0; i < pieces; ++i) {
    const double rest = std::min(1.0, pieces - i);
    part = part * Pose2{rest * piece_m.x(), rest * piece_m.y(), rest * turn_rad};
  }
  return part;
}

/// What a laser reads that moves while its beams go round.
LaserScan MeasureMoving(const Pose2& T_world_first,
                        const Pose2& T_first_last,
                        std::mt19937_64& random) {
  std::normal_distribution<double> range_noise_m(0.0, 0.01);
  std::normal_distribution<double> bearing_noise_rad(0.0, 0.002);
  LaserScan scan{
      .stamp = {}, .geometry = {}, .ranges_m = std::vector<float>(kBeams), .sweep = kSweep};
  scan.geometry.first_bearing_rad = -1.5707964F;
  scan.geometry.bearing_step_rad = 0.008726646F;
  scan.geometry.range_max_m = 30.0F;
  for (std::size_t i = 0; i < kBeams; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kBeams - 1);
    const Pose2 T_world_now = T_world_first * Part(T_first_last, share);
    const double bearing_rad =
        T_world_now.theta_rad + scan.geometry.Bearing(i) + bearing_noise_rad(random);
    const std::optional<double> range_m = test::CastRay(
        Room(), T_world_now.translation_m(), {std::cos(bearing_rad), std::sin(bearing_rad)});
    scan.ranges_m[i] = static_cast<float>(range_m.value() + range_noise_m(random));
  }
  return scan;
}

/// Mean error of matching a scan that was taken in motion with one taken at rest, as a distance at
/// 3 m from the robot.
double MeanError_m(const Pose2& T_first_last, bool deskews) {
  constexpr int kTrials = 200;
  std::mt19937_64 random(11);
  double sum_m = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const Pose2 T_world_first{-1.0 + 0.005 * i, 0.4 - 0.003 * i, NormalizeAngle(0.3 * i)};
    const LaserScan still = MeasureMoving(T_world_first, Pose2{}, random);
    const LaserScan moving = MeasureMoving(T_world_first, T_first_last, random);
    const MatchResult match =
        MatchScans(still, deskews ? Deskewed(moving, T_first_last) : moving, Pose2{});
    sum_m += match.T_ref_cur.translation_m().norm() + 3.0 * std::abs(match.T_ref_cur.theta_rad);
  }
  return sum_m / kTrials;
}

TEST(Deskewed, IsTheScanItselfWhereTheRobotStood) {
  std::mt19937_64 random(1);
  const LaserScan scan = MeasureMoving({}, {}, random);
  const LaserScan still = Deskewed(scan, Pose2{});
  EXPECT_EQ(still.ranges_m, scan.ranges_m);
  EXPECT_EQ(still.geometry, scan.geometry);
}

TEST(Deskewed, WidensTheAngleBetweenBeamsByTheTurn) {
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = std::vector<float>(11, 2.0F)};
  scan.geometry.bearing_step_rad = 0.1F;
  scan.geometry.range_max_m = 30.0F;
  const LaserScan still = Deskewed(scan, {0.0, 0.0, 0.2});
  EXPECT_NEAR(still.geometry.bearing_step_rad, 0.12F, 1e-6F);
  for (const float range_m : still.ranges_m) EXPECT_NEAR(range_m, 2.0F, 1e-5F);
}

// Of a wall along the way every reading is far from the next one.
TEST(Deskewed, KeepsAWallStraightThatIsSeenAtAGrazingAngle) {
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = std::vector<float>(21), .sweep = kSweep};
  scan.geometry.first_bearing_rad = 0.1F;
  scan.geometry.bearing_step_rad = 0.0087F;
  scan.geometry.range_max_m = 30.0F;
  const double aside_m = 1.0;
  const Pose2 T_first_last{0.05, 0.02, 0.0};
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double y_m = Part(T_first_last, static_cast<double>(i) / 20.0).y_m;
    scan.ranges_m[i] = static_cast<float>((aside_m - y_m) / std::sin(scan.geometry.Bearing(i)));
  }
  const LaserScan still = Deskewed(scan, T_first_last);
  int hits = 0;
  for (std::size_t i = 1; i + 1 < still.size(); ++i) {
    if (StateOf(still.ranges_m[i], still.geometry) != BeamState::kHit) continue;
    const double range_m = static_cast<double>(still.ranges_m[i]);
    EXPECT_NEAR(range_m * std::sin(still.geometry.Bearing(i)), aside_m, 0.002) << i;
    ++hits;
  }
  EXPECT_GE(hits, 17);
}

TEST(Deskewed, KeepsMissesWithTheirBeams) {
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = {2.0F, 30.0F, 0.0F, 2.0F}};
  scan.geometry.bearing_step_rad = 0.1F;
  scan.geometry.range_max_m = 30.0F;
  const LaserScan still = Deskewed(scan, {0.0, 0.0, 0.1});
  EXPECT_EQ(still.ranges_m[1], 30.0F);
  EXPECT_EQ(still.ranges_m[2], 0.0F);
}

// The odometry that began anew within a scan, too, and a turn that undoes that of the mirror, by
// which all beams would lie on one.
TEST(Deskewed, IsTheScanItselfWhereNoRobotMovesSo) {
  std::mt19937_64 random(1);
  const LaserScan scan = MeasureMoving({}, {}, random);
  for (const Pose2& motion : {Pose2{30.0, 0.0, 0.0}, Pose2{0.0, 0.0, -std::numbers::pi}}) {
    const LaserScan still = Deskewed(scan, motion);
    EXPECT_EQ(still.ranges_m, scan.ranges_m);
    EXPECT_EQ(still.geometry, scan.geometry);
  }
}

// Right before a laser that moves on, neighbouring beams come to lie anywhere.
TEST(Deskewed, TakesNoLongerWhereSurfacesAreNear) {
  LaserScan scan{
      .stamp = {}, .geometry = {}, .ranges_m = std::vector<float>(100'000), .sweep = kSweep};
  scan.geometry.first_bearing_rad = -std::numbers::pi_v<float>;
  scan.geometry.bearing_step_rad = 2e-5F * std::numbers::pi_v<float>;
  scan.geometry.range_max_m = 30.0F;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> range_m(0.01F, 0.05F);
  for (float& reading_m : scan.ranges_m) reading_m = range_m(random);
  const auto time = [&scan](const Pose2& T_first_last) {
    const auto begun = std::chrono::steady_clock::now();
    EXPECT_EQ(Deskewed(scan, T_first_last).size(), scan.size());
    return std::chrono::steady_clock::now() - begun;
  };
  const auto turning = time({0.0, 0.0, 0.1});
  EXPECT_LT(time({0.2, 0.0, 0.1}), 100 * turning);
}

// 2 rad/s and 1 m/s with 10 scans per second whose beams take all the time.
TEST(Deskewed, MatchesAsWellAsAScanTakenAtRest) {
  const Pose2 turning{0.0, 0.0, 0.2};
  const Pose2 driving{0.1, 0.0, 0.2};
  const double at_rest_m = MeanError_m(Pose2{}, false);
  for (const Pose2& motion : {turning, driving}) {
    const double skewed_m = MeanError_m(motion, false);
    const double deskewed_m = MeanError_m(motion, true);
    EXPECT_GT(skewed_m, 5.0 * at_rest_m);
    EXPECT_LT(deskewed_m, 1.2 * at_rest_m) << skewed_m << " m without";
  }
}

}  // namespace
}  // namespace qwsm
