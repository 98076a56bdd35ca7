// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// What is expected of a pose before a scan tells. Both have the same `T_a_b`.
struct PosePrediction {
  UncertainPose2 conservative;  ///< Pose as uncertain as a slip of the wheels may make it.
  UncertainPose2 adapted;       ///< Pose as uncertain as odometry has proved to be so far.

  /// No motion, and next to no error.
  static PosePrediction Unmoved() {
    constexpr double kSigma = 0.001;  // m, rad.
    const UncertainPose2 there{.T_a_b = {},
                               .covariance = kSigma * kSigma * Eigen::Matrix3d::Identity()};
    return {.conservative = there, .adapted = there};
  }
};

}  // namespace qwsm
