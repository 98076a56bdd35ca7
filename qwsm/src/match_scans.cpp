// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/match_scans.hpp"

#include <Eigen/Cholesky>

#include "qwsm/mapping/scan_locator.hpp"

namespace qwsm {
namespace {

// Of what is no number the decomposition would succeed.
bool IsPositiveDefinite(const Eigen::Matrix3d& covariance) {
  return covariance.allFinite() && covariance.llt().info() == Eigen::Success;
}

}  // namespace

MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const UncertainPose2& guess) {
  if (!IsPositiveDefinite(guess.covariance)) {
    return {.status = MatchStatus::kDegenerate, .T_ref_cur = guess.T_a_b, .predicted = guess};
  }
  ScanMap map;
  map.Insert(reference, {});
  return ScanLocator().Locate(map, ToPoints(scan), guess);
}

MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const Pose2& T_ref_cur_guess) {
  return MatchScans(
      reference, scan, UncertainPose2::WithSigmas(T_ref_cur_guess, kGuessSigma_m, kGuessSigma_rad));
}

}  // namespace qwsm
