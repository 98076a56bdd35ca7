// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/odometry_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "qwsm/geometry/angle.hpp"

namespace qwsm {
namespace {

constexpr double kSigma = 0.01;  // Of the odometry's motions, and of matches, in m and rad.
constexpr int kMotions = 1000;

/// What odometry gets wrong.
struct Errors {
  double way = 0.0;
  double turn = 0.0;
  double drift_rad_per_m = 0.0;
};

/// A robot that drives in curves, and is found where it went.
class DrivingRobot {
 public:
  DrivingRobot(const Errors& errors, double way_m) : errors_(errors), way_m_(way_m) {
    calibration_.Follow(T_odom_robot_, false);
  }

  /// @param slipped_m of which only odometry knows.
  void Step(double slipped_m = 0.0, bool is_turn_by_gyro = false) {
    const double turn_rad = sway_rad_ * std::sin(0.05 * ++steps_);
    const Pose2 told{
        .x_m = (way_m_ + slipped_m) / (1.0 - errors_.way),
        .theta_rad = (turn_rad + errors_.drift_rad_per_m * way_m_) / (1.0 - errors_.turn) +
                     noise_of_wheels_rad_ * normal_(random_)};
    T_odom_robot_ = T_odom_robot_ * told;
    const Pose2 T_before =
        std::exchange(T_calibrated_, *calibration_.Follow(T_odom_robot_, is_turn_by_gyro));
    told_ = T_before.Inverse() * T_calibrated_;
    moved_ = {.x_m = way_m_ + kSigma * normal_(random_),
              .theta_rad = turn_rad + kSigma * normal_(random_)};
    calibration_.Learn(before_,
                       {.T_a_b = told_, .covariance = noise_},
                       {.T_a_b = before_.T_a_b * moved_, .covariance = found_});
  }
  void Drive() {
    for (int i = 0; i < kMotions; ++i) Step();
  }

  /// All turns that odometry tells of are noise.
  void GoStraightOnByNoisyWheels() {
    sway_rad_ = 0.0;
    noise_of_wheels_rad_ = kSigma;
  }

  /// Of somebody who sees two parallel walls, ahead of which nothing is told but by who walks
  /// there.
  void SeeWallsOnly() {
    const Eigen::Vector2d onwards = before_.T_a_b.Rotation().col(0);
    found_.topLeftCorner<2, 2>() += 10.0 * kSigma * kSigma * onwards * onwards.transpose();
  }

  const OdometryCalibration& calibration() const { return calibration_; }
  /// The last motion, as it is told, and as it was.
  const Pose2& told() const { return told_; }
  const Pose2& moved() const { return moved_; }

 private:
  Errors errors_;
  double way_m_;
  double sway_rad_ = 0.2;
  double noise_of_wheels_rad_ = 0.0;
  OdometryCalibration calibration_;
  Eigen::Matrix3d noise_ = kSigma * kSigma * Eigen::Matrix3d::Identity();
  Eigen::Matrix3d found_ = noise_;
  UncertainPose2 before_{.T_a_b = {1.0, -2.0, 2.5}};
  int steps_ = 0;
  Pose2 T_odom_robot_{3.0, 1.0, -1.0};
  Pose2 T_calibrated_ = T_odom_robot_;
  Pose2 told_;
  Pose2 moved_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

constexpr Errors kErrors{.way = 0.04, .turn = 0.1, .drift_rad_per_m = 0.03};

TEST(OdometryCalibration, IsLearnedFromWhereTheRobotIsFoundWhicheverWayItGoes) {
  for (const double way_m : {0.3, -0.3}) {
    SCOPED_TRACE(way_m);
    DrivingRobot robot(kErrors, way_m);
    robot.Drive();
    EXPECT_NEAR(robot.calibration().way_error(), kErrors.way, 0.01);
    EXPECT_NEAR(robot.calibration().turn_error(), kErrors.turn, 0.02);
    EXPECT_NEAR(robot.calibration().drift_rad_per_m(), kErrors.drift_rad_per_m, 0.01);
    EXPECT_NEAR(robot.told().x_m, way_m, 0.01);
    EXPECT_NEAR(NormalizeAngle(robot.told().theta_rad - robot.moved().theta_rad), 0.0, 0.04);
  }
}

TEST(OdometryCalibration, OneSlipOfTheWheelsIsNoError) {
  DrivingRobot robot(kErrors, 0.3);
  robot.Drive();
  const double before = robot.calibration().way_error();
  robot.Step(0.2);
  EXPECT_NEAR(robot.calibration().way_error(), before, 0.01);
}

TEST(OdometryCalibration, NothingIsLearnedOfAWayThatWallsAloneDoNotTell) {
  DrivingRobot robot(kErrors, 0.3);
  robot.SeeWallsOnly();
  robot.Drive();
  EXPECT_EQ(robot.calibration().way_error(), 0.0);
  EXPECT_NEAR(robot.calibration().turn_error(), kErrors.turn, 0.02);
}

TEST(OdometryCalibration, TurnsThatAreNoiseTellOfNoErrorOfTurns) {
  DrivingRobot robot({}, 0.3);
  robot.GoStraightOnByNoisyWheels();
  robot.Drive();
  EXPECT_NEAR(robot.calibration().turn_error(), 0.0, 0.05);
}

TEST(OdometryCalibration, WhereNothingMovesNothingIsLearned) {
  OdometryCalibration calibration;
  const UncertainPose2 found = UncertainPose2::WithSigmas({.x_m = 0.1}, kSigma, kSigma);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(calibration.Follow(Pose2{.x_m = 1.0}, false), (Pose2{.x_m = 1.0}));
    calibration.Learn({}, {}, found);
  }
  EXPECT_EQ(calibration.way_error(), 0.0);
  EXPECT_EQ(calibration.turn_error(), 0.0);
}

TEST(OdometryCalibration, AnAbsurdReadingSpoilsNothing) {
  DrivingRobot robot(kErrors, 0.3);
  robot.Drive();
  robot.Step(1e300);
  EXPECT_NEAR(robot.calibration().way_error(), kErrors.way, 0.02);
  EXPECT_NEAR(robot.calibration().turn_error(), kErrors.turn, 0.02);
}

TEST(OdometryCalibration, ATurnByAGyroStaysWhatItIs) {
  DrivingRobot robot(kErrors, 0.3);
  for (int i = 0; i < kMotions; ++i) robot.Step(0.0, true);
  EXPECT_EQ(robot.calibration().turn_error(), 0.0);
  EXPECT_NEAR(robot.calibration().way_error(), kErrors.way, 0.01);
}

TEST(OdometryCalibration, GoesOnAfterOdometryWasGone) {
  OdometryCalibration calibration;
  calibration.Follow(Pose2{.x_m = 1.0}, false);
  EXPECT_FALSE(calibration.Follow(std::nullopt, false).has_value());
  EXPECT_EQ(calibration.Follow(Pose2{.x_m = 5.0}, false), (Pose2{.x_m = 5.0}));
}

}  // namespace
}  // namespace qwsm
