// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Why a match ended.
enum class MatchStatus {
  kConverged,
  kIterationLimit,  ///< The steps were still longer than the tolerance.
  kTooFewPairs,     ///< The scan and the reference have next to nothing in common.
  kDegenerate,      ///< Neither the pairs nor the prior tell the pose in some direction.
  kInconsistent,    ///< The best pose contradicts the prior, or too few points agree with it.
};

std::string_view Name(MatchStatus status);

/// What a match found. `T_ref_cur` is the best pose so far, whatever the status.
struct [[nodiscard]] MatchResult {
  MatchStatus status = MatchStatus::kTooFewPairs;
  Pose2 T_ref_cur;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of (x, y, theta), prior included.
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  ///< Of the pairs alone, as if independent.
  /// The covariance, were each pair the nearest sample as in the papers (Visser et al. 2009, eq.
  /// 3): with measurement noise and correspondence error, which shrinks as the reference gets
  /// denser.
  Eigen::Matrix3d nearest_sample_covariance = Eigen::Matrix3d::Zero();
  int iterations = 0;
  int pairs = 0;
  double mean_residual_m = 0.0;  ///< Mean distance of a point to its nearest stored point.
  double overlap = 0.0;          ///< Share of the scan's points that agree with the reference.
  double misfit = 1.0;  ///< Mean squared error of a pair, in units of its modelled variance.
};

/// How well the pairs of a match hold a position.
struct PositionHold {
  Eigen::Vector2d weakest;         ///< Unit vector: the direction that they hold least,
  double weakest_information = 0;  ///< and their information about it in 1/m^2, heading unknown.
  double strongest_information = 0;

  double share() const { return weakest_information / strongest_information; }
};
/// @param information of (x, y, theta).
PositionHold HoldOf(const Eigen::Matrix3d& information);

/// One line per iteration, for whoever wants to watch a match.
struct MatchIteration {
  Pose2 T_ref_cur;
  int pairs = 0;
  double mean_residual_m = 0.0;
  double doubt_m = 0.0;  ///< About the position, by which pairs are widened.
};
using MatchTrace = std::vector<MatchIteration>;

}  // namespace qwsm
