// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/match_scans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/scenes.hpp"
#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// How far two poses are apart, a radian counting as many metres.
double Apart(const Pose2& a, const Pose2& b) {
  const Pose2 difference = a.Inverse() * b;
  return difference.translation_m().norm() + std::abs(difference.theta_rad);
}

/// A furnished room, seen from two places half a metre and twenty degrees apart.
class MatchScansInRoom : public testing::Test {
 protected:
  MatchScansInRoom() {
    const Scene scene = FurnishedRoom();
    const Eigen::Vector2d from_m = scene.route_m[0];
    const Eigen::Vector2d way_m = scene.route_m[1] - from_m;
    const Pose2 T_world_ref{from_m.x(), from_m.y(), std::atan2(way_m.y(), way_m.x())};
    std::mt19937_64 random(5);
    reference_ = Measure({}, scene.world, T_world_ref, random);
    scan_ = Measure({}, scene.world, T_world_ref * T_ref_cur_, random);
  }

  const Pose2 T_ref_cur_{0.45, -0.2, DegreesToRadians(20.0)};
  LaserScan reference_;
  LaserScan scan_;
};

TEST_F(MatchScansInRoom, FindsTheMotionWithoutAGuess) {
  const MatchResult match = MatchScans(reference_, scan_);
  EXPECT_EQ(match.status, MatchStatus::kConverged);
  EXPECT_LT(Apart(match.T_ref_cur, T_ref_cur_), 0.03);
}

TEST_F(MatchScansInRoom, TellsAnUncertaintyThatFitsTheError) {
  const MatchResult match = MatchScans(reference_, scan_);
  const UncertainPose2 found{match.T_ref_cur, match.covariance};
  EXPECT_LT(found.SigmaXY_m(), 0.02);
  EXPECT_LT((match.T_ref_cur.translation_m() - T_ref_cur_.translation_m()).norm(),
            4.0 * std::sqrt(2.0) * found.SigmaXY_m());
}

TEST_F(MatchScansInRoom, SwappedScansGiveTheInverse) {
  const MatchResult there = MatchScans(reference_, scan_);
  const MatchResult back = MatchScans(scan_, reference_);
  EXPECT_LT(Apart(there.T_ref_cur, back.T_ref_cur.Inverse()), 0.02);
}

TEST_F(MatchScansInRoom, AMovedScanComposes) {
  // The same readings, told in the frame of something the robot pushes ahead of it.
  const Pose2 T_robot_pushed{0.8, 0.3, 1.1};
  LaserScan pushed = scan_;
  pushed.geometry.T_robot_laser = T_robot_pushed.Inverse() * scan_.geometry.T_robot_laser;
  const MatchResult match = MatchScans(reference_, scan_, T_ref_cur_);
  const MatchResult moved = MatchScans(reference_, pushed, T_ref_cur_ * T_robot_pushed);
  EXPECT_LT(Apart(moved.T_ref_cur, match.T_ref_cur * T_robot_pushed), 0.005);
}

TEST_F(MatchScansInRoom, AGuessThatIsSureIsFused) {
  const Pose2 wrong = T_ref_cur_ * Pose2{0.05, 0.0, 0.0};
  const MatchResult match =
      MatchScans(reference_, scan_, UncertainPose2::WithSigmas(wrong, 1e-5, 1e-5));
  EXPECT_LT(Apart(match.T_ref_cur, wrong), 1e-3);
}

TEST_F(MatchScansInRoom, ScansThatSawNothingAreNoMatch) {
  LaserScan blind = scan_;
  std::ranges::fill(blind.ranges_m, std::numeric_limits<float>::infinity());
  EXPECT_EQ(MatchScans(reference_, blind).status, MatchStatus::kTooFewPairs);
  EXPECT_EQ(MatchScans(blind, scan_).status, MatchStatus::kTooFewPairs);
  EXPECT_EQ(MatchScans(LaserScan{}, LaserScan{}).status, MatchStatus::kTooFewPairs);
}

TEST_F(MatchScansInRoom, AGuessWithoutUncertaintyIsDegenerate) {
  EXPECT_EQ(MatchScans(reference_, scan_, UncertainPose2{}).status, MatchStatus::kDegenerate);
}

TEST_F(MatchScansInRoom, AGuessWhoseCovarianceIsNoneIsDegenerate) {
  UncertainPose2 negative = UncertainPose2::WithSigmas(T_ref_cur_, 0.3, 0.17);
  negative.covariance(2, 2) = -0.03;
  UncertainPose2 indefinite = UncertainPose2::WithSigmas(T_ref_cur_, 1.0, 1.0);
  indefinite.covariance << 1.0, 0.9, 0.9, 0.9, 1.0, -0.9, 0.9, -0.9, 1.0;
  UncertainPose2 no_number = UncertainPose2::WithSigmas(T_ref_cur_, 0.3, 0.17);
  no_number.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  for (const UncertainPose2& guess : {negative, indefinite, no_number}) {
    const MatchResult match = MatchScans(reference_, scan_, guess);
    EXPECT_EQ(match.status, MatchStatus::kDegenerate);
    EXPECT_EQ(match.T_ref_cur, T_ref_cur_);
  }
}

}  // namespace
}  // namespace qwsm::test
