// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_failure.hpp"

#include <cmath>

#include "qwsm/mapping/dead_reckoning.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/pose_prediction.hpp"

namespace qwsm {
namespace {

// A chance of 1 in 100 that a scan fits so by chance, and the odds against a slip.
constexpr double kNatsAgainstOdometry = kConvincingNats + kSlipNats;

// No robot that maps as it drives is faster.
constexpr double kDriveAtMost_mps = 10.0;
constexpr double kTurnAtMost_rad_s = 10.0;

}  // namespace

bool IsTooFast(const Pose2& motion, std::chrono::duration<double> time) {
  return motion.translation_m().norm() > kDriveAtMost_mps * time.count() ||
         std::abs(motion.theta_rad) > kTurnAtMost_rad_s * time.count();
}

// Where nearly all of the scan is explained no pose is convincingly better. What fits nowhere near
// a place far off may well be new, if there was time to drive there.
bool OdometryFailure::IsPossible() const {
  if (doubt_.may_have_begun_anew) return true;
  if (HasMatched(by_odometry_) ? doubt_.is_surprising : HasJumped()) {
    return IsConvincinglyBetter(points_, 1.0, by_odometry_.overlap);
  }
  return !HasMatched(by_odometry_) && IsCalledBack();
}

// Where the map has called the robot farther off than odometry can be wrong, it has to explain much
// more of the scan there.
bool OdometryFailure::IsCalledBack() const {
  const Pose2& T_map_robot = by_odometry_.predicted.T_a_b;
  const double expected = PlaceEvidence::PointsOnSurfaces(map_, points_, T_map_robot).share;
  const double told = PlaceEvidence::ToldBySurfaces(points_);
  return LeadInNats(told, by_odometry_.overlap, expected) >= kNatsAgainstOdometry;
}

double OdometryFailure::LeastToShow() const {
  if (doubt_.may_have_begun_anew) return by_odometry_.overlap;
  return HasMatched(by_odometry_) ? LeastConvincing(points_, by_odometry_.overlap) : 0.0;
}

// The map calls the robot to the same place, wherever it is expected.
bool OdometryFailure::IsShownBy(const MatchResult& other) const {
  if (doubt_.may_have_begun_anew) return other.overlap >= by_odometry_.overlap;
  const auto is_better = [&] {
    return IsConvincinglyBetter(points_, other.overlap, by_odometry_.overlap);
  };
  if (HasMatched(by_odometry_)) return is_better();
  if (!HasMatched(other)) return false;
  return (HasJumped() && is_better()) || !IsFarFrom(other.pose(), by_odometry_.pose());
}

}  // namespace qwsm
