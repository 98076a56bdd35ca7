// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/paths_apart.hpp"

#include <algorithm>
#include <cmath>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/pose_prediction.hpp"

namespace qwsm {
namespace {

// A chance of 1 in 10 that what is seen of the map fits there by chance.
constexpr double kLeastOfTheRest = 2.3;

// By how much a scan speaks for the pose of the match rather than for the other one. What was put
// up since the paths parted lies where the matches had the robot: the map as it was before bears
// witness, unless next to nothing of it is seen.
double LeadOf(double told, const PathEnd& by_match, const PathEnd& by_odometry) {
  const PlaceFit matched{.told = told, .explained = by_match.explained_before};
  const PlaceFit reckoned{.told = told, .explained = by_odometry.explained_before};
  if (std::max(matched.NatsWithinMap(), reckoned.NatsWithinMap()) >= kLeastOfTheRest) {
    return LeadInNats(told, matched.explained, reckoned.explained);
  }
  return LeadInNats(told, by_match.match.overlap, by_odometry.match.overlap);
}

// By how many nats a slip of the wheels from where a scan is expected speaks against a pose.
double NatsAgainst(const UncertainPose2& expected, const UncertainPose2& slipped) {
  return std::min(kSlipNats, 0.5 * SquaredMahalanobisDistance(expected, slipped));
}

// Share of a scan that stands still where the match explains so much, if nobody hides more of it.
double LeastStill(const MatchResult& match, double max_moving_share) {
  return (1.0 - max_moving_share) * match.overlap;
}

}  // namespace

std::optional<PathsApart> PathsApart::Weigh(std::span<const ScanPoint> points,
                                            const std::optional<PathsApart>& before,
                                            const UncertainPose2& expected,
                                            const PathEnd& by_match,
                                            const PathEnd& by_odometry,
                                            double max_moving_share) {
  const double told = PlaceEvidence::ToldBySurfaces(points);
  const PlaceFit reckoned{.told = told, .explained = by_odometry.match.overlap};
  const bool shows_less = reckoned.explained <= by_match.match.overlap;
  const double least_still = LeastStill(by_match.match, max_moving_share);
  if (shows_less &&
      (reckoned.explained < least_still || reckoned.NatsWithinMap() < kLeastOfTheRest)) {
    return std::nullopt;
  }
  PathsApart apart = before.value_or(PathsApart{});
  apart.by_match_ = by_match.match.pose();
  apart.by_odometry_ = by_odometry.match.pose();
  apart.nats_for_match_ +=
      LeadOf(told, by_match, by_odometry) - NatsAgainst(expected, apart.by_match_);
  return apart;
}

bool PathsApart::is_decided() const { return std::abs(nats_for_match_) > kConvincingNats; }

double LeastToDoubt(std::span<const ScanPoint> points,
                    const MatchResult& match,
                    double max_moving_share) {
  const double told = PlaceEvidence::ToldBySurfaces(points);
  const double slip_untold = match.overlap - ShareForLead(told, kSlipNats);
  return std::max(0.0, std::min(LeastStill(match, max_moving_share), slip_untold));
}

bool IsSlipTold(std::span<const ScanPoint> points,
                const UncertainPose2& expected,
                const MatchResult& match,
                const MatchResult& by_odometry) {
  const double told = PlaceEvidence::ToldBySurfaces(points);
  const double explained = HasMatched(by_odometry) ? by_odometry.overlap : 0.0;
  return LeadInNats(told, match.overlap, explained) >= NatsAgainst(expected, match.pose());
}

void PathsApart::Move(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  by_match_ = new_old * by_match_;
  by_odometry_ = new_old * by_odometry_;
}

}  // namespace qwsm
