// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/match_result.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {

std::string_view Name(MatchStatus status) {
  switch (status) {
    case MatchStatus::kConverged:
      return "converged";
    case MatchStatus::kIterationLimit:
      return "iteration limit";
    case MatchStatus::kTooFewPairs:
      return "too few pairs";
    case MatchStatus::kDegenerate:
      return "degenerate";
    case MatchStatus::kInconsistent:
      return "inconsistent";
  }
  return "unknown";
}

bool HasMatched(const MatchResult& match) {
  return match.status == MatchStatus::kConverged || match.status == MatchStatus::kIterationLimit;
}

Eigen::Matrix3d InformationAdded(const MatchResult& match) {
  return match.covariance.inverse() - match.predicted.covariance.inverse();
}

UncertainPose2 ToldAlone(const MatchResult& match) {
  const Eigen::Matrix3d next_to_nothing = Eigen::Vector3d(0.1, 0.1, 1.0).asDiagonal();
  const Eigen::Matrix3d covariance =
      (PositivePart(InformationAdded(match)) + next_to_nothing).inverse();
  const Eigen::Vector3d away = covariance * match.predicted.covariance.inverse() *
                               Difference(match.T_ref_cur, match.predicted.T_a_b);
  return {.T_a_b = Shifted(match.T_ref_cur, away), .covariance = covariance};
}

Degeneracy DegeneracyOf(const Eigen::Matrix3d& information) {
  const Eigen::Vector2d cross = information.topRightCorner<2, 1>();
  const Eigen::Matrix2d of_position =
      information.topLeftCorner<2, 2>() -
      cross * cross.transpose() / std::max(information(2, 2), 1e-12);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(of_position);
  return {.weakest_direction = axes.eigenvectors().col(0),
          .weakest_information = std::max(0.0, axes.eigenvalues()(0)),
          .strongest_information = std::max(1e-12, axes.eigenvalues()(1))};
}

}  // namespace qwsm
