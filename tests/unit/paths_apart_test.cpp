// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/paths_apart.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace qwsm {
namespace {

constexpr double kMovingShare = 0.3;
const UncertainPose2 kExpected = UncertainPose2::WithSigmas({}, 0.01, 0.002);

/// Points of a wall, far enough apart that each tells of another surface.
std::vector<ScanPoint> SparseWall(int points) {
  std::vector<ScanPoint> wall;
  for (int i = 0; i < points; ++i) {
    wall.push_back({.p_robot_m = {0.2 * i, 1.0}, .beam_robot = Eigen::Vector2d::UnitY()});
  }
  return wall;
}

MatchResult MatchAt(double x_m, double overlap) {
  MatchResult match{.status = MatchStatus::kConverged, .T_ref_cur = {x_m, 0.0, 0.0}};
  match.covariance = kExpected.covariance;
  match.overlap = overlap;
  return match;
}

/// What is known after so many scans in which the matches' path goes on as odometry tells, but for
/// the first ones.
std::optional<PathsApart> After(int scans, int slips, double overlap_by_odometry) {
  const std::vector<ScanPoint> wall = SparseWall(60);
  std::optional<PathsApart> apart;
  for (int i = 0; i < scans; ++i) {
    const MatchResult by_match = MatchAt(0.3, 1.0);
    const UncertainPose2 expected = i < slips ? kExpected : by_match.pose();
    const MatchResult by_odometry = MatchAt(0.0, overlap_by_odometry);
    apart = PathsApart::Weigh(wall, apart, expected, {by_match}, {by_odometry}, kMovingShare);
  }
  return apart;
}

TEST(PathsApart, BelieveOdometryWhereWheelsWouldHaveToSlipWithEachScan) {
  const auto apart = After(3, 3, 0.95);
  ASSERT_TRUE(apart);
  EXPECT_TRUE(apart->is_by_odometry());
  EXPECT_TRUE(apart->is_decided());
}

TEST(PathsApart, BelieveMatchesWhereWheelsSlippedOnce) {
  const auto at_first = After(1, 1, 0.9);
  ASSERT_TRUE(at_first);
  EXPECT_TRUE(at_first->is_by_odometry());
  EXPECT_FALSE(at_first->is_decided());

  const auto then = After(5, 1, 0.9);
  ASSERT_TRUE(then);
  EXPECT_FALSE(then->is_by_odometry());
  EXPECT_TRUE(then->is_decided());
}

// A robot that comes back to what it has mapped long ago is not taken along by anybody.
TEST(PathsApart, BelieveWhatTheMapWasBefore) {
  const std::vector<ScanPoint> wall = SparseWall(60);
  const MatchResult by_match = MatchAt(0.3, 1.0);
  const MatchResult by_odometry = MatchAt(0.0, 1.0);
  const auto apart_with = [&](double by_match_before, double by_odometry_before) {
    return PathsApart::Weigh(wall,
                             {},
                             kExpected,
                             {by_match, by_match_before},
                             {by_odometry, by_odometry_before},
                             kMovingShare);
  };
  EXPECT_FALSE(apart_with(0.9, 0.6)->is_by_odometry());
  EXPECT_TRUE(apart_with(0.6, 0.9)->is_by_odometry());
  EXPECT_TRUE(apart_with(0.1, 0.0)->is_by_odometry()) << "next to nothing";
}

TEST(PathsApart, KnowBothPoses) {
  const PathsApart apart = *After(1, 1, 0.95);
  EXPECT_EQ(apart.by_match().T_a_b.x_m, 0.3);
  EXPECT_EQ(apart.by_odometry().T_a_b.x_m, 0.0);
}

TEST(PathsApart, AreNoneWhereTooMuchWouldHaveMoved) {
  EXPECT_TRUE(After(1, 1, 0.75));
  EXPECT_FALSE(After(1, 1, 0.65));
}

TEST(PathsApart, AreNoneWhereTheRestTellsLittle) {
  const auto weigh = [](int points) {
    const MatchResult by_match = MatchAt(0.3, 1.0);
    const MatchResult by_odometry = MatchAt(0.0, 0.95);
    return PathsApart::Weigh(
        SparseWall(points), {}, kExpected, {by_match}, {by_odometry}, kMovingShare);
  };
  EXPECT_TRUE(weigh(60));
  EXPECT_FALSE(weigh(10)) << "a few trees";
}

TEST(PathsApart, BelieveOdometryWhereThatShowsMore) {
  const MatchResult by_match = MatchAt(0.3, 0.4);
  const MatchResult by_odometry = MatchAt(0.0, 0.5);
  const auto apart =
      PathsApart::Weigh(SparseWall(10), {}, kExpected, {by_match}, {by_odometry}, kMovingShare);
  ASSERT_TRUE(apart);
  EXPECT_TRUE(apart->is_by_odometry());
}

TEST(PathsApart, FollowAMapThatIsMoved) {
  PathsApart apart = *After(1, 1, 0.95);
  apart.Move({3.0, -1.0, 0.0});
  EXPECT_DOUBLE_EQ(apart.by_match().T_a_b.x_m, 3.3);
  EXPECT_DOUBLE_EQ(apart.by_odometry().T_a_b.y_m, -1.0);
}

// Of five points three fit some wall or other; where odometry has the robot they are of a new one.
TEST(PathsApart, HaveNotSlippedWhereAFewPointsFitElsewhere) {
  const MatchResult elsewhere = MatchAt(2.0, 0.6);
  MatchResult by_odometry = MatchAt(0.0, 0.0);
  by_odometry.status = MatchStatus::kTooFewPairs;
  EXPECT_FALSE(IsSlipTold(SparseWall(5), kExpected, elsewhere, by_odometry));
  EXPECT_TRUE(IsSlipTold(SparseWall(60), kExpected, elsewhere, by_odometry));
  EXPECT_TRUE(IsSlipTold(SparseWall(5), elsewhere.pose(), elsewhere, by_odometry))
      << "that is where the matches go on";
}

// Where odometry has the robot is only sought for what explains so much.
TEST(PathsApart, LeaveTheMatchInNoDoubtByWhatExplainsLessThanTheLeast) {
  for (const int points : {6, 20, 60}) {
    SCOPED_TRACE(points);
    const std::vector<ScanPoint> wall = SparseWall(points);
    const MatchResult match = MatchAt(0.3, 0.95);
    const double least = LeastToDoubt(wall, match, kMovingShare);
    const auto is_doubted = [&](double explained) {
      const MatchResult there = MatchAt(0.0, explained);
      return PathsApart::Weigh(wall, {}, kExpected, {match}, {there}, kMovingShare) ||
             !IsSlipTold(wall, kExpected, match, there);
    };
    for (double explained = 0.0; explained < least; explained += 0.05) {
      EXPECT_FALSE(is_doubted(explained)) << explained;
    }
    EXPECT_TRUE(is_doubted(0.95));
  }
  EXPECT_GT(LeastToDoubt(SparseWall(60), MatchAt(0.3, 0.95), kMovingShare), 0.6);
}

}  // namespace
}  // namespace qwsm
