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
  explicit Circling(std::chrono::nanoseconds sweep) : sweep_(sweep) {}

  void Step() {
    stamp_ += kPeriod;
    T_odom_robot_ = T_odom_robot_ * kTold;
    T_map_robot_ = T_map_robot_ * Pose2{kTold.x_m, kTold.y_m - 0.01, kTold.theta_rad + 0.002};
    MappingStep step{.stamp = stamp_};
    step.status = StepStatus::kMatched;
    step.map_robot.T_a_b = {T_map_robot_.x_m + kMatch_m * normal_(random_),
                            T_map_robot_.y_m + kMatch_m * normal_(random_),
                            T_map_robot_.theta_rad + kMatch_rad * normal_(random_)};
    step.local_covariance = UncertainPose2::WithSigmas({}, kMatch_m, kMatch_rad).covariance;
    slip_.Learn(Told(), step);
  }

  /// Odometry begins anew elsewhere.
  void JumpInOdometry() { T_odom_robot_ = {50.0, -20.0, 1.0}; }

  const SlipEstimator& slip() const { return slip_; }

 private:
  static constexpr Pose2 kTold{0.04, 0.004, 0.2};

  Observation Told() const {
    Observation told{.scan = {}, .T_odom_robot = T_odom_robot_};
    told.scan.stamp = stamp_;
    told.scan.deskewed_sweep = sweep_;
    return told;
  }

  std::chrono::nanoseconds sweep_;
  SlipEstimator slip_;
  Timestamp stamp_{};
  Pose2 T_odom_robot_;
  Pose2 T_map_robot_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

TEST(SlipEstimator, LearnsWhatWheelsDoNotFeel) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  EXPECT_NEAR(robot.slip().slip().x(), 0.0, 0.01);
  EXPECT_NEAR(robot.slip().slip().y(), -0.1, 0.01);
  EXPECT_NEAR(robot.slip().slip().z(), 0.02, 0.005);
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
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = std::vector<float>(11, 2.0F)};
  scan.geometry.bearing_step_rad = 0.1F;
  scan.geometry.range_max_m = 30.0F;
  EXPECT_EQ(robot.slip().Mended(scan).ranges_m, scan.ranges_m);
}

TEST(SlipEstimator, MovesBeamsByTheSlipWithinAScan) {
  Circling robot(90ms);
  for (int i = 0; i < 30; ++i) robot.Step();
  // A wall to the left; the robot slips away from it.
  LaserScan scan{.stamp = {}, .geometry = {}, .ranges_m = {2.0F, 2.0F, 2.0F}};
  scan.geometry.first_bearing_rad = 1.5607963F;
  scan.geometry.bearing_step_rad = 0.01F;
  scan.geometry.range_max_m = 30.0F;
  scan.deskewed_sweep = 100ms;
  const LaserScan mended = robot.slip().Mended(scan);
  EXPECT_NEAR(mended.ranges_m.front(), 2.0F, 0.001F);
  EXPECT_NEAR(mended.ranges_m.back(), 1.99F, 0.002F);
}

}  // namespace
}  // namespace qwsm
