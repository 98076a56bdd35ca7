// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/wheel_creep.hpp"

#include <gtest/gtest.h>

#include <random>

namespace qwsm {
namespace {

constexpr double kCreep = 0.04;
constexpr double kSigma_m = 0.01;  // Of the odometry's motions, and of matches.
constexpr int kMotions = 500;

/// A robot that is found 0.3 m on, forwards or backwards, where its wheels tell of more.
class CreepingRobot {
 public:
  explicit CreepingRobot(double way_m) : way_m_(way_m) {}

  void Step(double slipped_m = 0.0) {
    const Pose2 told{.x_m = (way_m_ + slipped_m) / (1.0 - kCreep)};
    const UncertainPose2 motion{.T_a_b = creep_.TakenOut(told), .covariance = noise_};
    const Pose2 moved{.x_m = way_m_ + kSigma_m * normal_(random_)};
    creep_.Learn(before_, motion, {.T_a_b = before_.T_a_b * moved, .covariance = noise_});
  }

  const WheelCreep& creep() const { return creep_; }

 private:
  double way_m_;
  WheelCreep creep_;
  Eigen::Matrix3d noise_ = kSigma_m * kSigma_m * Eigen::Matrix3d::Identity();
  UncertainPose2 before_{.T_a_b = {1.0, -2.0, 2.5}};
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
};

TEST(WheelCreep, IsLearnedFromWhereTheRobotIsFoundWhicheverWayItGoes) {
  for (const double way_m : {0.3, -0.3}) {
    SCOPED_TRACE(way_m);
    CreepingRobot robot(way_m);
    for (int i = 0; i < kMotions; ++i) robot.Step();
    EXPECT_NEAR(robot.creep().share(), kCreep, 0.01);
    const Pose2 motion = robot.creep().TakenOut({.x_m = 1.0, .y_m = 0.1, .theta_rad = 0.2});
    EXPECT_NEAR(motion.x_m, 1.0 - kCreep, 0.01);
    EXPECT_EQ(motion.theta_rad, 0.2) << "it turns as it is told";
  }
}

TEST(WheelCreep, OneSlipOfTheWheelsIsNoCreep) {
  CreepingRobot robot(0.3);
  for (int i = 0; i < kMotions; ++i) robot.Step();
  const double before = robot.creep().share();
  robot.Step(0.2);
  EXPECT_NEAR(robot.creep().share(), before, 0.01);
}

TEST(WheelCreep, WhereNothingMovesNothingIsLearned) {
  CreepingRobot robot(0.0);
  for (int i = 0; i < kMotions; ++i) robot.Step();
  EXPECT_EQ(robot.creep().share(), 0.0);
}

}  // namespace
}  // namespace qwsm
