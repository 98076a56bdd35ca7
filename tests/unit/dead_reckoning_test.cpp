// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/dead_reckoning.hpp"

#include <gtest/gtest.h>

namespace qwsm {
namespace {

const UncertainPose2 kStep = UncertainPose2::WithSigmas({0.1, 0.0, 0.0}, 0.01, 0.002);

UncertainPose2 MatchedAt(double x_m) {
  return UncertainPose2::WithSigmas({x_m, 0.0, 0.0}, 0.005, 0.001);
}

/// Follows a robot of which each match stays behind by so much more.
DeadReckoning AfterScans(int scans, double behind_m) {
  DeadReckoning reckoning;
  for (int i = 0; i < scans; ++i) reckoning.Follow(kStep, MatchedAt(i * (0.1 - behind_m)));
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
