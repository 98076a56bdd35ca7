// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/position.hpp"

namespace qwsm {
namespace {

// Whoever is not sure of the continent is not to be believed; nor can numbers that large be summed
// with those of a match.
constexpr double kLargestVariance = kFarthestCoordinate_m * kFarthestCoordinate_m;

// Whether no two coordinates vary together by more than each alone allows, but for rounding.
bool HasCorrelations(const Eigen::Matrix3d& covariance) {
  constexpr double kRounding = 1.0 + 1e-6;
  const Eigen::Vector3d sigmas = covariance.diagonal().cwiseSqrt();
  const Eigen::Matrix3d most = kRounding * sigmas * sigmas.transpose();
  return (covariance.cwiseAbs().array() <= most.array()).all();
}

}  // namespace

bool IsPosition(const Pose2& pose) {
  return IsCoordinate(pose.x_m) && IsCoordinate(pose.y_m) && std::isfinite(pose.theta_rad);
}

std::string_view ObjectionTo(const UncertainPose2& pose) {
  if (!IsPosition(pose.T_a_b)) return "the pose is not finite, or more than 10000 km away";
  if (!pose.covariance.allFinite() || pose.covariance.diagonal().minCoeff() < 0.0) {
    return "the covariance is not finite, or its diagonal is negative";
  }
  if (pose.covariance.diagonal().maxCoeff() > kLargestVariance) {
    return "the covariance is larger than that of a pose anywhere on Earth";
  }
  if (!HasCorrelations(pose.covariance)) return "the covariance has correlations beyond one";
  return {};
}

}  // namespace qwsm
