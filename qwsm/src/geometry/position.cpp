// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/position.hpp"

namespace qwsm {

bool IsPosition(const Pose2& pose) {
  return IsCoordinate(pose.x_m) && IsCoordinate(pose.y_m) && std::isfinite(pose.theta_rad);
}

std::string_view ObjectionTo(const UncertainPose2& pose) {
  if (!IsPosition(pose.T_a_b)) return "the pose is not finite, or more than 10000 km away";
  if (!pose.covariance.allFinite() || pose.covariance.diagonal().minCoeff() < 0.0) {
    return "the covariance is not finite, or its diagonal is negative";
  }
  return {};
}

}  // namespace qwsm
