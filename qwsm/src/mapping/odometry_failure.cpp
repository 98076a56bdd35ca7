// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_failure.hpp"

#include "qwsm/mapping/dead_reckoning.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/pose_prediction.hpp"

namespace qwsm {
namespace {

// A chance of 1 in 100 that a scan fits so by chance, and the odds against a slip.
constexpr double kNatsAgainstOdometry = kConvincingNats + kSlipNats;

}  // namespace

// Where nearly all of the scan is explained no pose is convincingly better. Where the map has
// called the robot farther off than odometry can be wrong, it has to explain much more of it there.
bool OdometryFailure::IsPossible(bool is_surprising) const {
  if (is_suspect_) return true;
  if (HasMatched(by_odometry_)) {
    return is_surprising && IsConvincinglyBetter(points_, 1.0, by_odometry_.overlap);
  }
  const Pose2& T_map_robot = by_odometry_.predicted.T_a_b;
  const double expected = PlaceEvidence::PointsOnSurfaces(map_, points_, T_map_robot).share;
  const double told = PlaceEvidence::ToldBySurfaces(points_);
  return LeadInNats(told, by_odometry_.overlap, expected) >= kNatsAgainstOdometry;
}

double OdometryFailure::LeastToShow() const {
  if (is_suspect_) return by_odometry_.overlap;
  return HasMatched(by_odometry_) ? LeastConvincing(points_, by_odometry_.overlap) : 0.0;
}

// The map calls the robot to the same place, wherever it is expected.
bool OdometryFailure::IsShownBy(const MatchResult& other) const {
  if (is_suspect_) return other.overlap >= by_odometry_.overlap;
  if (HasMatched(by_odometry_)) {
    return IsConvincinglyBetter(points_, other.overlap, by_odometry_.overlap);
  }
  return HasMatched(other) && !IsFarFrom(other.pose(), by_odometry_.pose());
}

}  // namespace qwsm
