// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/geometry/position.hpp"

namespace slam6d {

std::string_view ObjectionTo(const UncertainPose3& pose) {
  if (!IsPosition(pose.T_a_b)) return "the pose is not finite, or more than 10000 km away";
  if (!pose.covariance.allFinite() || pose.covariance.diagonal().minCoeff() < 0.0) {
    return "the covariance is not finite, or its diagonal is negative";
  }
  return {};
}

}  // namespace slam6d
