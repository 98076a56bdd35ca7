// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/gyro_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace qwsm {
namespace {

constexpr double kTurnSigma_rad = 0.003;  // Of a turn that a match finds.
constexpr double kPeriod_s = 0.5;

/// A robot that turns to and fro on grass: its wheels tell a fifth more.
class TurningRobot {
 public:
  explicit TurningRobot(double bias_rad_s,
                        double gyro_factor = 1.0,
                        double turn_sigma_rad = kTurnSigma_rad)
      : bias_rad_s_(bias_rad_s), gyro_factor_(gyro_factor), turn_sigma_rad_(turn_sigma_rad) {}

  void Step() {
    ++steps_;
    const double turn_rad = 0.1 * std::sin(0.2 * steps_);
    truth_rad_ += turn_rad;
    T_wheels_robot_ = T_wheels_robot_ * Pose2{.x_m = 0.1, .theta_rad = 1.2 * turn_rad};
    gyro_rad_ += gyro_factor_ * turn_rad + bias_rad_s_ * kPeriod_s;
    Observation observation{.scan = {}, .T_odom_robot = T_wheels_robot_, .gyro_rad = gyro_rad_};
    observation.scan.stamp =
        std::chrono::round<Timestamp>(std::chrono::duration<double>(kPeriod_s * steps_));
    const double before_rad = T_odom_robot_.theta_rad;
    T_odom_robot_ = *odometry_.Follow(observation);
    const double told_rad = NormalizeAngle(T_odom_robot_.theta_rad - before_rad);
    if (steps_ > 1) odometry_.Learn(turn_rad + turn_sigma_rad_ * normal_(random_), turn_sigma_rad_);
    if (steps_ > 200) {
      by_gyro_rad2_ += std::pow(told_rad - turn_rad, 2);
      by_wheels_rad2_ += std::pow(0.2 * turn_rad, 2);
    }
  }

  /// Error of the heading's motions over that of the wheels, root mean square.
  double Share() const { return std::sqrt(by_gyro_rad2_ / by_wheels_rad2_); }
  const GyroOdometry& odometry() const { return odometry_; }
  const Pose2& T_odom_robot() const { return T_odom_robot_; }
  const Pose2& T_wheels_robot() const { return T_wheels_robot_; }

 private:
  double bias_rad_s_;
  double gyro_factor_;
  double turn_sigma_rad_;
  GyroOdometry odometry_;
  int steps_ = 0;
  double truth_rad_ = 0.0;
  double gyro_rad_ = 0.0;
  double by_gyro_rad2_ = 0.0;
  double by_wheels_rad2_ = 0.0;
  Pose2 T_wheels_robot_;
  Pose2 T_odom_robot_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

TEST(GyroOdometry, LearnsTheBias) {
  TurningRobot turning(0.02);
  for (int i = 0; i < 400; ++i) turning.Step();
  EXPECT_TRUE(turning.odometry().leads());
  EXPECT_NEAR(turning.odometry().bias_rad_s(), 0.02, 0.001);
  EXPECT_LT(turning.Share(), 0.5) << "the error of the heading is halved, and more";
}

// Among few trees matches tell soon that it is better than the wheels, and late what its bias is.
TEST(GyroOdometry, CountsOnceItsBiasIsKnown) {
  TurningRobot turning(0.02, 1.0, 0.02);
  for (int i = 0; i < 100; ++i) turning.Step();
  EXPECT_FALSE(turning.odometry().leads());
  for (int i = 0; i < 300; ++i) turning.Step();
  EXPECT_TRUE(turning.odometry().leads());
}

TEST(GyroOdometry, DoesWithoutAGyroThatIsUpsideDown) {
  TurningRobot turning(0.0, -1.0);
  for (int i = 0; i < 400; ++i) turning.Step();
  EXPECT_FALSE(turning.odometry().leads());
  EXPECT_LT(turning.Share(), 1.05);
}

TEST(GyroOdometry, WithoutAGyroIsTheWheels) {
  GyroOdometry odometry;
  Observation observation;
  EXPECT_FALSE(odometry.Follow(observation));
  for (const Pose2& T_odom_robot : {Pose2{1.0, 2.0, 3.0}, Pose2{1.1, 2.3, -3.1}, Pose2{}}) {
    observation.T_odom_robot = T_odom_robot;
    EXPECT_EQ(odometry.Follow(observation), T_odom_robot);
    odometry.Learn(0.1, 0.01);
  }
}

}  // namespace
}  // namespace qwsm
