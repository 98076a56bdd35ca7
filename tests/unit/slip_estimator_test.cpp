// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/slip_estimator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

namespace qwsm {
namespace {

using namespace std::chrono_literals;

constexpr double kMatch_m = 0.002;
constexpr double kMatch_rad = 0.0005;
constexpr std::chrono::milliseconds kPeriod = 100ms;

/// A robot in a circle, whose wheels do not tell that it slips aside.
class Circling {
 public:
  explicit Circling(std::chrono::nanoseconds sweep, bool has_odometry = true)
      : sweep_(sweep), has_odometry_(has_odometry) {}

  void Step() {
    stamp_ += kPeriod;
    T_odom_robot_ = T_odom_robot_ * kTold;
    T_map_robot_ = T_map_robot_ * kMoved;
    // A scan that is moved by too little is found to be taken later on the way.
    const Pose2 missing = InHalfASweep(Untold() - Believed());
    const Pose2 T_map_found = T_map_robot_ * missing;
    MappingStep step{.stamp = stamp_};
    step.status = StepStatus::kMatched;
    step.map_robot.T_a_b = {T_map_found.x_m + kMatch_m * normal_(random_),
                            T_map_found.y_m + kMatch_m * normal_(random_),
                            T_map_found.theta_rad + kMatch_rad * normal_(random_)};
    step.local_covariance = UncertainPose2::WithSigmas({}, kMatch_m, kMatch_rad).covariance;
    const Observation told = Told();
    slip_.Learn(told, slip_.Mended(told).velocity, step);
  }

  /// Odometry begins anew elsewhere.
  void JumpInOdometry() { T_odom_robot_ = {50.0, -20.0, 1.0}; }

  const SlipEstimator& slip() const { return slip_; }

 private:
  static constexpr Pose2 kTold{0.04, 0.004, 0.2};
  static constexpr Pose2 kMoved{0.04, -0.006, 0.202};

  Eigen::Vector3d Untold() const {
    const Pose2 told = has_odometry_ ? kTold : Pose2{};
    const Eigen::Vector3d missed(
        kMoved.x_m - told.x_m, kMoved.y_m - told.y_m, kMoved.theta_rad - told.theta_rad);
    return missed / std::chrono::duration<double>(kPeriod).count();
  }
  Eigen::Vector3d Believed() const { return has_odometry_ ? slip_.slip() : slip_.velocity(); }
  Pose2 InHalfASweep(const Eigen::Vector3d& velocity) const {
    const Eigen::Vector3d moved = 0.5 * std::chrono::duration<double>(sweep_).count() * velocity;
    return {moved.x(), moved.y(), moved.z()};
  }

  Observation Told() const {
    Observation told;
    if (has_odometry_) told.T_odom_robot = T_odom_robot_;
    told.scan.stamp = stamp_;
    told.scan.deskewed_sweep = sweep_;
    return told;
  }

  std::chrono::nanoseconds sweep_;
  bool has_odometry_;
  SlipEstimator slip_;
  Timestamp stamp_{};
  Pose2 T_odom_robot_;
  Pose2 T_map_robot_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

/// A wall to the left, two metres away.
LaserScan Wall() {
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = {2.0F, 2.0F, 2.0F}};
  scan.geometry.first_bearing_rad = 1.5607963F;
  scan.geometry.bearing_step_rad = 0.01F;
  scan.geometry.range_max_m = 30.0F;
  return scan;
}

TEST(SlipEstimator, LearnsWhatWheelsDoNotFeel) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  EXPECT_NEAR(robot.slip().slip().x(), 0.0, 0.01);
  EXPECT_NEAR(robot.slip().slip().y(), -0.1, 0.01);
  EXPECT_NEAR(robot.slip().slip().z(), 0.02, 0.005);
}

// What is believed changes where a scan is found to be taken, which is not to be taken for motion.
TEST(SlipEstimator, LearnsAllMotionWithoutOdometry) {
  Circling robot(90ms, false);
  for (int i = 0; i < 5; ++i) robot.Step();
  EXPECT_NEAR(robot.slip().velocity().x(), 0.4, 0.05);
  EXPECT_NEAR(robot.slip().velocity().z(), 2.02, 0.02);
  EXPECT_EQ(robot.slip().slip(), Eigen::Vector3d::Zero());
}

TEST(SlipEstimator, IsNotLedAstrayByOdometryThatJumps) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  robot.JumpInOdometry();
  robot.Step();
  EXPECT_NEAR(robot.slip().slip().y(), -0.1, 0.03);
}

TEST(SlipEstimator, LeavesScansAloneWhoseBeamsHaveNoTimes) {
  Circling robot(0ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  EXPECT_EQ(robot.slip().slip(), Eigen::Vector3d::Zero());
  EXPECT_EQ(robot.slip().Mended({.scan = Wall(), .T_odom_robot = Pose2{}}).scan.ranges_m,
            Wall().ranges_m);
}

TEST(SlipEstimator, LeavesScansAloneThatOdometryCouldHaveBroughtToOnePlace) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  LaserScan scan = Wall();
  scan.sweep = 100ms;
  EXPECT_EQ(robot.slip().Mended({.scan = scan, .T_odom_robot = Pose2{}}).scan.ranges_m,
            Wall().ranges_m);
}

TEST(SlipEstimator, MovesBeamsByTheSlipWithinAScan) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  LaserScan scan = Wall();  // The robot slips away from it.
  scan.deskewed_sweep = 100ms;
  const LaserScan mended = robot.slip().Mended({.scan = scan, .T_odom_robot = Pose2{}}).scan;
  EXPECT_NEAR(mended.ranges_m.front(), 2.0F, 0.001F);
  EXPECT_NEAR(mended.ranges_m.back(), 1.99F, 0.002F);
}

TEST(SlipEstimator, BringsBeamsToOnePlaceWithoutOdometry) {
  Circling robot(90ms, false);
  for (int i = 0; i < 30; ++i) robot.Step();
  LaserScan scan = Wall();
  scan.sweep = 100ms;
  const LaserScan mended = robot.slip().Mended({.scan = scan}).scan;
  EXPECT_EQ(mended.sweep.count(), 0);
  EXPECT_EQ(mended.deskewed_sweep, 100ms);
  EXPECT_NEAR(mended.geometry.bearing_step_rad, 0.01F + 0.101F, 0.003F);
}

}  // namespace
}  // namespace qwsm
