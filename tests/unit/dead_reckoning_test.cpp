// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace qwsm {
namespace {

const UncertainPose2 kStep = UncertainPose2::WithSigmas({0.1, 0.0, 0.0}, 0.01, 0.002);

UncertainPose2 MatchedAt(double x_m) {
  return UncertainPose2::WithSigmas({x_m, 0.0, 0.0}, 0.005, 0.001);
}

/// Follows a robot of which each match stays behind by so much more.
DeadReckoning AfterScans(int scans, double behind_m) {
  DeadReckoning reckoning;
  for (int i = 0; i < scans; ++i) {
    const UncertainPose2 matched = MatchedAt(i * (0.1 - behind_m));
    reckoning.Follow(kStep, matched.T_a_b, matched.covariance.inverse(), 0);
  }
  return reckoning;
}

TEST(DeadReckoning, GoesBackTenToTwentyScans) {
  for (const int scans : {11, 15, 20, 25, 100}) {
    const DeadReckoning reckoning = AfterScans(scans, 0.05);
    const std::optional<UncertainPose2> reckoned = reckoning.Predict(kStep);
    ASSERT_TRUE(reckoned) << scans;
    const double ahead_m = reckoned->T_a_b.x_m - 0.05 * scans;
    EXPECT_GE(ahead_m, 0.05 * 10 - 1e-9) << scans;
    EXPECT_LE(ahead_m, 0.05 * 20 + 1e-9) << scans;
  }
}

TEST(DeadReckoning, KnowsWhatTheMapHadWhenItBegan) {
  DeadReckoning reckoning;
  for (std::size_t i = 0; i < 25; ++i) {
    reckoning.Follow(kStep, {}, MatchedAt(0.0).covariance.inverse(), i);
  }
  EXPECT_EQ(reckoning.scans_before(), 10U);
}

TEST(DeadReckoning, SaysNothingBefore) {
  EXPECT_FALSE(AfterScans(9, 0.0).Predict(kStep));
  DeadReckoning reckoning = AfterScans(30, 0.0);
  reckoning.Clear();
  EXPECT_FALSE(reckoning.Predict(kStep));
}

TEST(DeadReckoning, KnowsWhatOdometryMayBeOffBy) {
  const UncertainPose2 reckoned = *AfterScans(20, 0.0).Predict(kStep);
  EXPECT_FALSE(IsFarFrom(reckoned, MatchedAt(2.0)));
  EXPECT_FALSE(IsFarFrom(reckoned, MatchedAt(1.9)));  // Two sigmas of twenty steps.
  EXPECT_TRUE(IsFarFrom(reckoned, MatchedAt(1.5)));
}

// Where scans tell nothing, as along a corridor, it is as uncertain as odometry has proved to be.
TEST(DeadReckoning, BeginsWhereOdometryHasTheRobotIfScansTellNothing) {
  DeadReckoning reckoning = AfterScans(20, 0.0);
  for (int i = 20; i < 40; ++i) {
    reckoning.Follow(kStep, {i * 0.1, 0.0, 0.0}, Eigen::Matrix3d::Zero(), 0);
  }
  const UncertainPose2 reckoned = *reckoning.Predict(kStep);
  EXPECT_GT(reckoned.SigmaXY_m(), 0.01 * std::sqrt(20.0));
  EXPECT_LT(reckoned.SigmaXY_m(), 2.0 * 0.01 * std::sqrt(41.0));
}

TEST(DeadReckoning, FollowsAMapThatIsMoved) {
  DeadReckoning reckoning = AfterScans(30, 0.0);
  const Pose2 T_new_old{3.0, -1.0, 0.5};
  const Pose2 before = reckoning.Predict(kStep)->T_a_b;
  reckoning.Move(T_new_old);
  const Pose2 expected = T_new_old * before;
  const Pose2 after = reckoning.Predict(kStep)->T_a_b;
  EXPECT_NEAR(after.x_m, expected.x_m, 1e-12);
  EXPECT_NEAR(after.y_m, expected.y_m, 1e-12);
  EXPECT_NEAR(after.theta_rad, expected.theta_rad, 1e-12);
}

}  // namespace
}  // namespace qwsm
