// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/moving_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

constexpr double kHalfWidth_m = 1.4;  // Of a corridor along x,
constexpr double kBody_m = 0.25;      // and half of those in it.
constexpr double kSpeed_mps = 0.5;
constexpr Timestamp kStep = 100ms;

double RangeTo(const Eigen::Vector2d& middle_m, const Eigen::Vector2d& along) {
  const double nearest_m = middle_m.dot(along);
  const double beside2_m2 = middle_m.squaredNorm() - nearest_m * nearest_m;
  const double inside_m2 = kBody_m * kBody_m - beside2_m2;
  if (nearest_m < 0.0 || inside_m2 < 0.0) return std::numeric_limits<double>::infinity();
  return nearest_m - std::sqrt(inside_m2);
}

/// What a robot at x sees of the corridor and of the bodies in it.
LaserScan ScanAt(double x_m, const std::vector<Eigen::Vector2d>& bodies_m, Timestamp stamp) {
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

/// A robot that drives along the corridor, and a body that begins somewhere and moves.
class Drive {
 public:
  explicit Drive(double body_x_m, Timestamp step = kStep) : step_(step), body_m_(body_x_m, -0.7) {}

  /// Lets odometry turn, though the robot does not.
  void LetOdometryTurn(double rate_radps) { odometry_radps_ = rate_radps; }

  void For(Timestamp duration, double body_mps) {
    for (Timestamp end = stamp_ + duration; stamp_ < end; stamp_ += step_) {
      found_m_ = bodies_.Follow(ScanAt(x_m_, {body_m_}, stamp_),
                                Pose2{.x_m = x_m_, .theta_rad = odometry_rad_});
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

 private:
  MovingBodies bodies_;
  Timestamp step_;
  Timestamp stamp_{};
  double x_m_ = 0.0;
  double odometry_radps_ = 0.0;
  double odometry_rad_ = 0.0;
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

TEST(MovingBodies, AreForgottenWhereTheClockIsSet) {
  MovingBodies bodies;
  const std::vector<Eigen::Vector2d> body_m{{4.0, -0.7}};
  for (int i = 0; i < 20; ++i) bodies.Follow(ScanAt(0.0, body_m, 24h + i * kStep), {});
  EXPECT_EQ(bodies.Follow(ScanAt(0.0, body_m, 24h + 20 * kStep), {}).size(), 0U);
  bodies.Follow(ScanAt(0.0, body_m, 0h), {});
  EXPECT_EQ(bodies.Follow(ScanAt(0.0, body_m, kStep), {}).size(), 1U);  // Not known to stand.
}

TEST(MovingBodies, AreNoWalls) {
  Drive drive(-20.0);  // Out of sight.
  drive.For(3s, 0.0);
  EXPECT_EQ(drive.found(), 0U);
}

}  // namespace
}  // namespace qwsm::team
