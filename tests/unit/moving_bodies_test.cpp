// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/moving_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace qwsm {
namespace {

using namespace std::chrono_literals;

constexpr double kHalfWidth_m = 1.4;  // Of a corridor along x,
constexpr double kBody_m = 0.25;      // and half of those in it.
constexpr double kSpeed_mps = 0.5;
constexpr Timestamp kBetweenScans = 100ms;

double RangeTo(const Eigen::Vector2d& middle_m, const Eigen::Vector2d& along) {
  const double nearest_m = middle_m.dot(along);
  const double beside2_m2 = middle_m.squaredNorm() - nearest_m * nearest_m;
  const double inside_m2 = kBody_m * kBody_m - beside2_m2;
  if (nearest_m < 0.0 || inside_m2 < 0.0) return std::numeric_limits<double>::infinity();
  return nearest_m - std::sqrt(inside_m2);
}

/// What a robot at x sees of the corridor and of the bodies in it.
LaserScan ScanInCorridor(double x_m,
                         const std::vector<Eigen::Vector2d>& bodies_m,
                         Timestamp stamp) {
  LaserScan scan{.stamp = stamp,
                 .geometry = {.first_bearing_rad = -1.57F,
                              .bearing_step_rad = static_cast<float>(std::numbers::pi / 180.0),
                              .range_min_m = 0.1F,
                              .range_max_m = 8.0F,
                              .T_robot_laser = {}},
                 .ranges_m = {}};
  for (std::size_t beam = 0; beam < 181; ++beam) {
    const double bearing_rad = scan.geometry.Bearing(beam);
    const Eigen::Vector2d along(std::cos(bearing_rad), std::sin(bearing_rad));
    double range_m = kHalfWidth_m / std::abs(along.y());
    for (const Eigen::Vector2d& body_m : bodies_m) {
      range_m = std::min(range_m, RangeTo(body_m - Eigen::Vector2d(x_m, 0.0), along));
    }
    scan.ranges_m.push_back(static_cast<float>(std::min(range_m, 8.0)));
  }
  return scan;
}

// Whoever is not known to stand after so long moves.
std::vector<Eigen::Vector2d> NotStanding(const MovingBodies& bodies) {
  std::vector<Eigen::Vector2d> found_m;
  for (const MovingBodies::Seen& body : bodies.seen()) {
    if (body.moves || body.followed < 1s) found_m.push_back(body.p_robot_m);
  }
  return found_m;
}

/// A robot that drives along the corridor, and a body that begins somewhere and moves.
class Drive {
 public:
  explicit Drive(double body_x_m, Timestamp step = kBetweenScans)
      : step_(step), body_m_(body_x_m, -0.7) {}

  /// Lets odometry turn, though the robot does not.
  void LetOdometryTurn(double rate_radps) { odometry_radps_ = rate_radps; }

  /// Takes the robot along, as the map has it that it was drawn by, at the speed of the body.
  void LetMapSlide() { map_slides_ = true; }

  void For(Timestamp duration, double body_mps) {
    for (Timestamp end = stamp_ + duration; stamp_ < end; stamp_ += step_) {
      const Pose2 T_odom_robot{.x_m = x_m_, .theta_rad = odometry_rad_};
      bodies_.Follow(ScanInCorridor(x_m_, {body_m_}, stamp_), T_odom_robot);
      bodies_.Place(map_slides_ ? Pose2{.x_m = x_m_ - body_m_.x()} : T_odom_robot);
      found_m_ = NotStanding(bodies_);
      off_m_ = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& found_m : found_m_) {
        off_m_ = std::min(off_m_, (found_m + Eigen::Vector2d(x_m_, 0.0) - body_m_).norm());
      }
      const double step_s = std::chrono::duration<double>(step_).count();
      x_m_ += step_s * kSpeed_mps;
      body_m_.x() += step_s * body_mps;
      odometry_rad_ += step_s * odometry_radps_;
    }
  }

  bool IsBodyFound() const { return off_m_ < 2.0 * kBody_m; }
  std::size_t found() const { return found_m_.size(); }
  const MovingBodies& bodies() const { return bodies_; }
  LaserScan Scan() const { return ScanInCorridor(x_m_, {body_m_}, stamp_); }
  Pose2 T_odom_robot() const { return {.x_m = x_m_, .theta_rad = odometry_rad_}; }

 private:
  MovingBodies bodies_;
  Timestamp step_;
  Timestamp stamp_{};
  double x_m_ = 0.0;
  double odometry_radps_ = 0.0;
  double odometry_rad_ = 0.0;
  bool map_slides_ = false;
  Eigen::Vector2d body_m_;
  std::vector<Eigen::Vector2d> found_m_;
  double off_m_ = 0.0;
};

TEST(MovingBodies, AreFoundWhereOneComesAlong) {
  Drive drive(7.0);
  drive.For(1500ms, -kSpeed_mps);
  EXPECT_TRUE(drive.IsBodyFound());
  drive.For(3s, -kSpeed_mps);
  EXPECT_TRUE(drive.IsBodyFound());
}

TEST(MovingBodies, AreFoundWhereOneDrivesAhead) {
  Drive drive(3.0);
  drive.For(3s, kSpeed_mps);
  EXPECT_TRUE(drive.IsBodyFound());
}

TEST(MovingBodies, AreFoundWhereOneDrivesAlongside) {
  Drive drive(1.0);
  drive.For(3s, kSpeed_mps);
  EXPECT_TRUE(drive.IsBodyFound());
}

// Seven metres off this is 0.35 m in a second.
TEST(MovingBodies, AreNotThoseThatErringOdometryTurns) {
  for (const double rate_radps : {-0.05, 0.05}) {
    SCOPED_TRACE(rate_radps);
    Drive drive(7.0);
    drive.LetOdometryTurn(rate_radps);
    drive.For(3s, 0.0);
    EXPECT_EQ(drive.found(), 0U);
  }
}

TEST(MovingBodies, AreNoneUntilItIsKnownThatTheyStand) {
  Drive drive(7.0);
  drive.For(500ms, 0.0);
  EXPECT_TRUE(drive.IsBodyFound());
  drive.For(1s, 0.0);
  EXPECT_EQ(drive.found(), 0U);
  drive.For(5s, 0.0);
  EXPECT_EQ(drive.found(), 0U);
}

TEST(MovingBodies, AreStillThoseThatHaveStopped) {
  Drive drive(7.0);
  drive.For(1500ms, -kSpeed_mps);
  drive.For(3s, 0.0);
  EXPECT_TRUE(drive.IsBodyFound());
}

TEST(MovingBodies, AreNoneWhereScansAreTooSeldomToFollowThem) {
  Drive drive(7.0, 1s);
  for (int scan = 0; scan < 5; ++scan) {
    drive.For(1s, 0.0);
    EXPECT_EQ(drive.found(), 0U);
  }
}

// Wheels that slip make all of a park move, and the map does not.
TEST(MovingBodies, AreNoneThatStandInTheMap) {
  Drive drive(3.0);
  drive.LetMapSlide();
  drive.For(3s, kSpeed_mps);
  EXPECT_EQ(drive.found(), 0U);
}

TEST(MovingBodies, AreHiddenInScansOnceTheyHaveMoved) {
  Drive drive(3.0);
  drive.For(2s, kSpeed_mps);
  MovingBodies bodies = drive.bodies();
  const Observation before{.scan = drive.Scan(), .T_odom_robot = drive.T_odom_robot()};
  const Observation after = bodies.HiddenIn(before);
  std::size_t hidden = 0;
  for (std::size_t beam = 0; beam < before.scan.size(); ++beam) {
    if (std::isnan(after.scan.ranges_m[beam])) ++hidden;
  }
  ASSERT_EQ(bodies.seen().size(), 1U);
  const MovingBodies::Seen body = bodies.seen().front();
  EXPECT_EQ(hidden, body.last_beam + 1 - body.first_beam);
  EXPECT_GT(hidden, 5U);
}

TEST(MovingBodies, AreNoneWithoutOdometry) {
  Drive drive(3.0);
  drive.For(2s, kSpeed_mps);
  MovingBodies bodies = drive.bodies();
  const Observation after = bodies.HiddenIn({.scan = drive.Scan(), .T_odom_robot = {}});
  EXPECT_EQ(after.scan.ranges_m, drive.Scan().ranges_m);
  EXPECT_TRUE(bodies.seen().empty());
}

// What has just come into view may walk.
TEST(MovingBodies, PassUntilTheyAreSeenToStand) {
  Drive drive(1.5);
  drive.For(200ms, 0.0);
  const std::vector<ScanPoint> points = ToPoints(ScanInCorridor(0.0, {{1.5, -0.7}}, 100ms));
  std::vector<std::uint8_t> marks;
  drive.bodies().MarkPassing(points, marks);
  const auto passing = std::ranges::count(marks, 1);
  EXPECT_GT(passing, 1);
  EXPECT_LT(passing, 40);
  drive.For(300ms, 0.0);
  marks.clear();
  drive.bodies().MarkPassing(points, marks);
  EXPECT_TRUE(marks.empty());
}

// Beyond the end of the laser's reach the corner of a wall looks as if it stood free.
TEST(MovingBodies, DoNotPassWhereNothingIsSeenBehindThem) {
  const std::vector<Eigen::Vector2d> ahead_m{{6.0, 0.0}};
  for (const double reach_m : {20.0, 7.0}) {
    SCOPED_TRACE(reach_m);
    MovingBodies bodies;
    LaserScan scan;
    for (int i = 0; i < 2; ++i) {
      scan = ScanInCorridor(0.0, ahead_m, i * kBetweenScans);
      scan.geometry.range_max_m = static_cast<float>(reach_m);
      bodies.Follow(scan, {});
      bodies.Place({});
    }
    std::vector<std::uint8_t> marks;
    bodies.MarkPassing(ToPoints(scan), marks);
    EXPECT_EQ(bodies.seen().size(), 1U);
    EXPECT_EQ(marks.empty(), reach_m < 8.0);
  }
}

TEST(MovingBodies, AreForgottenWhereTheClockIsSet) {
  MovingBodies bodies;
  const auto follow = [&](Timestamp stamp) {
    bodies.Follow(ScanInCorridor(0.0, {{4.0, -0.7}}, stamp), {});
    bodies.Place({});
    return NotStanding(bodies).size();
  };
  for (int i = 0; i < 20; ++i) follow(24h + i * kBetweenScans);
  EXPECT_EQ(follow(24h + 20 * kBetweenScans), 0U);
  follow(0h);
  EXPECT_EQ(follow(kBetweenScans), 1U);  // Not known to stand.
}

TEST(MovingBodies, AreNoWalls) {
  Drive drive(-20.0);  // Out of sight.
  drive.For(3s, 0.0);
  EXPECT_EQ(drive.found(), 0U);
}

}  // namespace
}  // namespace qwsm
