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
///
/// Two uncertainties stand in it, and neither follows from the other. `covariance` is what the
/// iterations weigh pairs against the prior with, and says how far the answer may be off now;
/// `pair_information` is what the residuals show once they have ended, without the prior, for
/// whoever fuses the pairs with something else.
struct [[nodiscard]] MatchResult {
  MatchStatus status = MatchStatus::kTooFewPairs;
  Pose2 T_ref_cur;
  /// The prediction that the answer was fused with.
  UncertainPose2 predicted{};
  /// Covariance of (x, y, theta) in the answer, prior included. Pairs count by the error model
  /// times `reduced_chi2`, and `correlated_points` of them as one.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Information about (x, y, theta) of the pairs alone, without the prior: by the scatter of their
  /// residuals (White 1980) where the match ended by itself, else by the error model.
  Eigen::Matrix3d pair_information = Eigen::Matrix3d::Zero();
  /// The covariance of (x, y, theta), were each pair the nearest sample as in Visser et al. (2009),
  /// Eq. (3): with measurement noise and correspondence error, which shrinks as the reference gets
  /// denser. For comparison with theirs only.
  Eigen::Matrix3d nearest_sample_covariance = Eigen::Matrix3d::Zero();
  int iterations = 0;
  int pairs = 0;
  double mean_residual_m = 0.0;  ///< Mean distance of a point to its nearest stored point.
  /// Share of the scan that agrees with the reference, in which points close together count less:
  /// see NewsOf().
  double overlap = 0.0;
  /// Reduced chi-square of the pairs: their mean squared error in units of its modelled variance.
  double reduced_chi2 = 1.0;

  UncertainPose2 pose() const { return {.T_a_b = T_ref_cur, .covariance = covariance}; }
};

/// Whether the pose is one that pairs tell.
bool HasMatched(const MatchResult& match);

/// Information about (x, y, theta) by which the answer is more certain than its prediction.
Eigen::Matrix3d InformationAdded(const MatchResult& match);

/// What the pairs tell of the pose, without the prediction they were fused with. What they tell
/// nothing of is known to metres.
UncertainPose2 ToldAlone(const MatchResult& match);

/// In which direction of the plane information about a pose is least, and how degenerate it is
/// (Zhang, Kaess & Singh 2016): along a corridor the walls tell next to nothing.
struct Degeneracy {
  Eigen::Vector2d weakest_direction;  ///< Unit vector, in the axes of the information.
  double weakest_information = 0;     ///< About the position along it in 1/m^2, heading unknown.
  double strongest_information = 0;   ///< About the position across it.

  /// Ratio of the least to the most information: 0 where nothing is told of the weakest direction,
  /// 1 where no direction is weaker than another.
  double ratio() const { return weakest_information / strongest_information; }
};
/// @param information of (x, y, theta).
Degeneracy DegeneracyOf(const Eigen::Matrix3d& information);

/// How a match stands after one iteration, for whoever wants to watch it.
struct MatchIteration {
  Pose2 T_ref_cur;
  int pairs = 0;
  double mean_residual_m = 0.0;
  double start_error_m = 0.0;  ///< Sigma of the start's position that annealing has left.
};
/// One entry per iteration.
using MatchTrace = std::vector<MatchIteration>;

}  // namespace qwsm
