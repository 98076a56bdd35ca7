// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How probable the pose of a match is, beside all others that its prediction allows.
#include "qwsm/matching/mode_probability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace qwsm {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// The side of a trunk that is seen from the origin, 12 m off at a bearing.
Points TrunkAt(double bearing_rad) {
  Points side_m;
  for (double beside_m = -0.2; beside_m <= 0.2; beside_m += 0.05) {
    const double range_m = 12.0 + beside_m * beside_m;
    const double angle_rad = bearing_rad + beside_m / range_m;
    side_m.emplace_back(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
  }
  return side_m;
}

LikelihoodPyramid MapOf(const std::vector<Points>& trunks) {
  LikelihoodPyramid map;
  for (const Points& trunk_m : trunks) {
    for (const Eigen::Vector2d& p_m : trunk_m) map.Insert(p_m, 0.0);
  }
  return map;
}

/// What a scan from the origin shows of trunks: two points of each.
std::vector<ScanPoint> ScanOf(const std::vector<Points>& trunks) {
  std::vector<ScanPoint> points;
  for (const Points& trunk_m : trunks) {
    for (const std::size_t i : {trunk_m.size() / 3, 2 * trunk_m.size() / 3}) {
      points.push_back({.p_robot_m = trunk_m[i], .beam_robot = trunk_m[i].normalized()});
    }
  }
  return points;
}

/// A match at the origin, as sure as matches are.
MatchResult MatchedAtOrigin(double predicted_sigma_rad) {
  MatchResult match;
  match.status = MatchStatus::kConverged;
  match.predicted = UncertainPose2::WithSigmas({}, 0.2, predicted_sigma_rad);
  match.covariance = UncertainPose2::WithSigmas({}, 0.03, 0.005).covariance;
  return match;
}

constexpr double kApart_rad = 0.5;
constexpr double kTurned_rad = 0.6;  // The robot has just turned without anything in view.
constexpr double kDrove_rad = 0.03;

TEST(ModeProbability, OfOneTrunkBesideOthersThatAreLikeItIsSmall) {
  const auto map = MapOf({TrunkAt(0.0), TrunkAt(kApart_rad), TrunkAt(-kApart_rad)});
  EXPECT_LT(ProbabilityOfMode(map, ScanOf({TrunkAt(0.0)}), MatchedAtOrigin(kTurned_rad)), 0.6);
}

TEST(ModeProbability, OfOneTrunkIsGreatWhereThePredictionTellsItFromOthers) {
  const auto map = MapOf({TrunkAt(0.0), TrunkAt(kApart_rad), TrunkAt(-kApart_rad)});
  EXPECT_GT(ProbabilityOfMode(map, ScanOf({TrunkAt(0.0)}), MatchedAtOrigin(kDrove_rad)), 0.95);
}

TEST(ModeProbability, OfTrunksThatStandTogetherAsNowhereElseIsGreat) {
  const auto map =
      MapOf({TrunkAt(0.0), TrunkAt(0.2), TrunkAt(kApart_rad), TrunkAt(-kApart_rad - 0.1)});
  const auto scan = ScanOf({TrunkAt(0.0), TrunkAt(0.2)});
  EXPECT_GT(ProbabilityOfMode(map, scan, MatchedAtOrigin(kTurned_rad)), 0.9);
}

TEST(ModeProbability, SharesItselfAmongTrunksByTheirPrior) {
  std::vector<Points> trunks;
  double prior = 0.0;
  for (const double bearing_rad : {0.0, 0.4, -0.4, 0.8, -0.8}) {
    SCOPED_TRACE(bearing_rad);
    trunks.push_back(TrunkAt(bearing_rad));
    prior += std::exp(-0.5 * std::pow(bearing_rad / kTurned_rad, 2));
    const double probability =
        ProbabilityOfMode(MapOf(trunks), ScanOf({TrunkAt(0.0)}), MatchedAtOrigin(kTurned_rad));
    EXPECT_NEAR(probability * prior, 1.0, 0.35);
  }
}

TEST(ModeProbability, OfOneTrunkIsOneWhereThePredictionLeavesNoDoubt) {
  MatchResult match = MatchedAtOrigin(kTurned_rad);
  match.predicted.covariance.setZero();
  EXPECT_EQ(ProbabilityOfMode(MapOf({TrunkAt(0.0)}), ScanOf({TrunkAt(0.0)}), match), 1.0);
}

TEST(ModeProbability, OfManyPointsIsNotAsked) {
  std::vector<Points> trunks;
  for (int i = 0; i < 10; ++i) trunks.push_back(TrunkAt(0.2 * i));
  EXPECT_EQ(ProbabilityOfMode(MapOf({}), ScanOf(trunks), MatchedAtOrigin(kTurned_rad)), 1.0);
}

}  // namespace
}  // namespace qwsm
