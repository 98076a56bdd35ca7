// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/free_space.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "qwsm/sensor/laser_mountings.hpp"

namespace qwsm::test {
namespace {

using std::numbers::pi;
constexpr float kRange_m = 5.0F;

/// A laser in the middle of a round room.
LaserScan InARoundRoom(double first_rad,
                       double last_rad,
                       int beams,
                       const Pose2& T_robot_laser = {}) {
  LaserScan scan;
  scan.ranges_m.assign(static_cast<std::size_t>(beams), kRange_m);
  scan.geometry = {.first_bearing_rad = static_cast<float>(first_rad),
                   .bearing_step_rad = static_cast<float>((last_rad - first_rad) / (beams - 1)),
                   .range_min_m = 0.1F,
                   .range_max_m = 20.0F,
                   .T_robot_laser = T_robot_laser};
  return scan;
}

Eigen::Vector2d SeenTowards(double bearing_rad, double range_m) {
  return range_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
}

bool SawThrough(const FreeRangeImage& image, const Eigen::Vector2d& p_map_m) {
  const ScanPoint point{.p_robot_m = p_map_m, .beam_robot = Eigen::Vector2d::UnitX()};
  std::uint8_t seen_through = 0;
  image.MarkSeenThrough(std::span(&point, 1), {}, std::span(&seen_through, 1));
  return seen_through != 0;
}

struct Turning {
  std::string name;
  double first_rad;
  double last_rad;
};

class FreeRangeImageOf : public testing::TestWithParam<Turning> {};

TEST_P(FreeRangeImageOf, SawThroughAllBeforeItsBeamsEndedAndNothingElse) {
  const Turning& turning = GetParam();
  const Pose2 T_map_robot{2.0, -3.0, 2.5};
  const Pose2 T_robot_laser{0.3, 0.1, -1.0};
  const LaserScan scan = InARoundRoom(turning.first_rad, turning.last_rad, 361, T_robot_laser);
  const FreeRangeImage image(scan, T_map_robot, {});
  const Pose2 T_map_laser = T_map_robot * T_robot_laser;
  const double middle_rad = 0.5 * (turning.first_rad + turning.last_rad);
  const double half_rad = 0.5 * std::abs(turning.last_rad - turning.first_rad);
  constexpr double kBorder_rad = 0.05;  // Where some neighbouring beams are missing.
  for (double off_rad = -pi + 0.01; off_rad < pi; off_rad += 0.01) {
    const bool is_in_view = std::abs(off_rad) < half_rad - kBorder_rad;
    if (!is_in_view && std::abs(off_rad) < half_rad + kBorder_rad) continue;
    SCOPED_TRACE(off_rad);
    const double bearing_rad = middle_rad + off_rad;
    EXPECT_EQ(SawThrough(image, T_map_laser * SeenTowards(bearing_rad, 4.6)), is_in_view);
    EXPECT_FALSE(SawThrough(image, T_map_laser * SeenTowards(bearing_rad, 4.8)));  // Within the margin.
    EXPECT_FALSE(SawThrough(image, T_map_laser * SeenTowards(bearing_rad, 5.5)));
  }
}

INSTANTIATE_TEST_SUITE_P(Lasers,
                         FreeRangeImageOf,
                         testing::Values(Turning{"Forwards", -0.5 * pi, 0.5 * pi},
                                         Turning{"Clockwise", 0.75 * pi, -0.75 * pi},
                                         Turning{"AllAround", -pi, pi},
                                         Turning{"FromZero", 0.0, 2.0 * pi}),
                         [](const auto& tested) { return tested.param.name; });

TEST(FreeRangeImage, KnowsNothingWhereABeamNearbyBroughtNoEcho) {
  LaserScan scan = InARoundRoom(-1.0, 1.0, 201);
  scan.ranges_m[100] = std::numeric_limits<float>::quiet_NaN();
  const FreeRangeImage image(scan, {}, {.margin_beams = 2});
  EXPECT_FALSE(SawThrough(image, SeenTowards(0.0, 2.0)));
  EXPECT_FALSE(SawThrough(image, SeenTowards(0.02, 2.0)));
  EXPECT_TRUE(SawThrough(image, SeenTowards(0.05, 2.0)));
}

TEST(FreeRangeImage, IsNotMistakenAtTheLaserItself) {
  EXPECT_TRUE(SawThrough(FreeRangeImage(InARoundRoom(-pi, pi, 361), {}, {}), {0.0, 0.0}));
}

class WhoWalksIn : public testing::Test {
 protected:
  WhoWalksIn() { seen_free_.Add(scan_, {}); }

  void Enter(std::size_t first_beam, std::size_t beams) {
    for (std::size_t i = first_beam; i < first_beam + beams; ++i) scan_.ranges_m[i] = 2.0F;
  }

  LaserScan scan_ = InARoundRoom(-0.5 * pi, 0.5 * pi, 181);
  FreeSpace seen_free_;
};

TEST_F(WhoWalksIn, IsLeftOut) {
  Enter(80, 10);
  const std::vector<ScanPoint> points = ToPoints(scan_);
  const std::vector<ScanPoint> still = seen_free_.WithoutMoving(points, {});
  EXPECT_EQ(still.size(), points.size() - 10);
  for (const ScanPoint& point : still) EXPECT_GT(point.range_m, 4.0);

  const LaserScan kept = WithoutMarked(scan_, points, seen_free_.MovingAmong(points, {}));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(std::isnan(kept.ranges_m[i]), i >= 80 && i < 90) << i;
  }
}

TEST_F(WhoWalksIn, IsForgottenAfterSoManyScans) {
  Enter(80, 10);
  for (int i = 0; i < FreeSpaceOptions{}.scans; ++i) seen_free_.Add(scan_, {});
  EXPECT_EQ(seen_free_.WithoutMoving(ToPoints(scan_), {}).size(), scan_.size());
}

TEST_F(WhoWalksIn, IsForgottenOfALaserThatIsMountedAnewForEachScan) {
  Enter(80, 10);
  const auto scans = kMostMountings * static_cast<std::size_t>(FreeSpaceOptions{}.scans);
  LaserScan scan = scan_;
  for (std::size_t i = 0; i < scans; ++i) {
    EXPECT_LT(seen_free_.WithoutMoving(ToPoints(scan_), {}).size(), scan_.size());
    scan.geometry.T_robot_laser.x_m += 1e-6;
    seen_free_.Add(scan, {});
  }
  EXPECT_EQ(seen_free_.WithoutMoving(ToPoints(scan_), {}).size(), scan_.size());
}

TEST_F(WhoWalksIn, IsNoLongerToldFromAWrongPoseWhereAllSeemsToMove) {
  Enter(20, 140);
  EXPECT_EQ(seen_free_.WithoutMoving(ToPoints(scan_), {}).size(), scan_.size());
}

TEST(FreeSpace, KeepsApartWhatLasersWithOtherBeamsSaw) {
  const LaserScan ahead = InARoundRoom(-0.5 * pi, 0.5 * pi, 181);
  LaserScan behind = InARoundRoom(0.5 * pi, 1.5 * pi, 361, {-0.2, 0.0, 0.0});
  behind.ranges_m.resize(300);
  FreeSpace seen_free;
  for (const LaserScan& scan : {ahead, behind, ahead, behind}) seen_free.Add(scan, {});
  const LaserScan all_around = InARoundRoom(-pi, pi, 100);
  std::vector<ScanPoint> points = ToPoints(all_around);
  for (ScanPoint& point : points) {
    if (point.beam % 5 == 0) point.p_robot_m *= 0.5;
  }
  const std::vector<std::uint8_t> moving = seen_free.MovingAmong(points, {});
  ASSERT_EQ(moving.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint8_t seen_through = 0;
    for (const LaserScan& scan : {ahead, behind}) {
      FreeRangeImage(scan, {}, {}).MarkSeenThrough(
          std::span(&points[i], 1), {}, std::span(&seen_through, 1));
    }
    EXPECT_EQ(moving[i], seen_through) << i;
  }
}

}  // namespace
}  // namespace qwsm::test
