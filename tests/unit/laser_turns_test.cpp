// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/laser_turns.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qwsm {
namespace {

using namespace std::chrono_literals;

constexpr Pose2 kFront{0.2, 0.0, 0.0};
constexpr Pose2 kRear{-0.2, 0.0, 3.0};
constexpr double kMatchSigma_m = 0.004;

Observation At(const Pose2& T_robot_laser, std::chrono::milliseconds stamp) {
  Observation observation;
  observation.scan.stamp = stamp;
  observation.T_odom_robot = Pose2{};
  observation.scan.geometry.T_robot_laser = T_robot_laser;
  return observation;
}

/// A match that says x, after a prediction that says next to nothing.
MappingStep FoundAt(double x_m, double sigma_m = kMatchSigma_m) {
  MappingStep step{.status = StepStatus::kMatched};
  step.match.predicted = UncertainPose2::WithSigmas({.x_m = x_m}, 1.0, 1.0);
  step.match.T_ref_cur = {.x_m = x_m};
  step.match.covariance = UncertainPose2::WithSigmas({}, sigma_m, sigma_m).covariance;
  step.map_robot.T_a_b = step.match.T_ref_cur;
  return step;
}

/// Front and rear half a period apart, until the stamp.
LaserTurns TakingTurns(std::chrono::milliseconds until) {
  LaserTurns turns;
  for (auto stamp = 0ms; stamp < until; stamp += 50ms) {
    turns.Note(At(stamp % 100ms == 0ms ? kFront : kRear, stamp), FoundAt(0.0), false);
  }
  return turns;
}

TEST(LaserTurns, AnOnlyLaserIsAsBefore) {
  LaserTurns turns;
  for (auto stamp = 0ms; stamp < 1s; stamp += 100ms) {
    EXPECT_EQ(turns.ShareOfPeriod(At(kFront, stamp).scan), 1.0);
    EXPECT_FALSE(turns.ToldByOthers(At(kFront, stamp)));
    turns.Note(At(kFront, stamp), FoundAt(0.0), false);
    EXPECT_FALSE(turns.take_turns());
  }
}

TEST(LaserTurns, TheTimeBetweenTwoScansOfALaserIsShared) {
  const LaserTurns turns = TakingTurns(1s);  // The rear one was last, at 950 ms.
  EXPECT_TRUE(turns.take_turns());
  EXPECT_DOUBLE_EQ(turns.ShareOfPeriod(At(kFront, 1000ms).scan), 0.5);
  EXPECT_DOUBLE_EQ(turns.ShareOfPeriod(At(kFront, 950ms).scan), 0.0) << "the same moment";
  EXPECT_DOUBLE_EQ(turns.ShareOfPeriod(At({1.0, 0.0, 0.0}, 960ms).scan), 1.0) << "a new one";
}

TEST(LaserTurns, WhatOthersToldIsPassedOn) {
  LaserTurns turns = TakingTurns(1s);
  turns.Note(At(kFront, 1000ms), FoundAt(0.01), false);
  const std::optional<UncertainPose2> told = turns.ToldByOthers(At(kRear, 1000ms));
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->T_a_b.x_m, 0.01, 1e-4);
  EXPECT_NEAR(std::sqrt(told->covariance(0, 0)), kMatchSigma_m, 0.1 * kMatchSigma_m);
}

// Else the front laser's word would come back to it by way of the rear one, as a second opinion.
TEST(LaserTurns, NoScanCountsTwice) {
  LaserTurns turns = TakingTurns(1s);
  MappingStep fused = FoundAt(0.0, 0.5 * kMatchSigma_m);
  fused.match.predicted = UncertainPose2::WithSigmas({.x_m = -0.003}, 0.6 * kMatchSigma_m, kMatchSigma_m);
  turns.Note(At(kRear, 1000ms), fused, false);
  const std::optional<UncertainPose2> told = turns.ToldByOthers(At(kFront, 1000ms));
  ASSERT_TRUE(told);
  // Of 4 parts of information, 2.78 were the prediction's.
  EXPECT_NEAR(told->T_a_b.x_m, 0.003 * 2.78 / 1.22, 2e-4);
  EXPECT_NEAR(std::sqrt(told->covariance(0, 0)), kMatchSigma_m / std::sqrt(1.22), 0.1 * kMatchSigma_m);
}

TEST(LaserTurns, ALaserThatIsHeardNoMoreIsForgottenWithinAPeriod) {
  LaserTurns turns = TakingTurns(1s);
  for (auto stamp = 1000ms; stamp < 1500ms; stamp += 100ms) {
    turns.Note(At(kFront, stamp), FoundAt(0.0), false);
  }
  EXPECT_FALSE(turns.take_turns());
  EXPECT_FALSE(turns.ToldByOthers(At(kFront, 1500ms)));
  EXPECT_EQ(turns.ShareOfPeriod(At(kFront, 1500ms).scan), 1.0);
  // When it is back, its pause is nobody's period.
  EXPECT_DOUBLE_EQ(turns.ShareOfPeriod(At(kRear, 1450ms).scan), 0.5);
}

TEST(LaserTurns, TheNextScanTellsWhereTheLastOneWasTaken) {
  LaserTurns turns = TakingTurns(1s);
  turns.Note(At(kRear, 1000ms), FoundAt(0.01), false);
  const UncertainPose2 before = UncertainPose2::WithSigmas({}, kMatchSigma_m, kMatchSigma_m);
  const UncertainPose2 after = turns.WithHindsight(before, At(kFront, 1000ms));
  EXPECT_NEAR(after.T_a_b.x_m, 0.005, 5e-4);
  EXPECT_LT(after.covariance(0, 0), 0.6 * before.covariance(0, 0));
}

TEST(LaserTurns, DistancesAreOfEachLaser) {
  LaserTurns turns;
  turns.Note(At(kFront, 0ms), FoundAt(0.0), true);
  turns.Note(At(kRear, 50ms), FoundAt(0.1), true);
  turns.Note(At(kFront, 100ms), FoundAt(0.2), false);
  EXPECT_EQ(turns.LastFarPoseOf(At(kFront, 150ms).scan)->x_m, 0.0);
  EXPECT_EQ(turns.LastFarPoseOf(At(kRear, 150ms).scan)->x_m, 0.1);
  EXPECT_FALSE(turns.LastFarPoseOf(At({1.0, 0.0, 0.0}, 150ms).scan));
}

}  // namespace
}  // namespace qwsm
