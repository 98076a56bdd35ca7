// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Wheels slip with one scan of a hundred: so many nats speak against it.
inline constexpr double kSlipNats = 4.6;

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

/// What is expected in the frame of a path, of which the motion since its end is predicted.
inline PosePrediction operator*(const UncertainPose2& map_last, const PosePrediction& last_robot) {
  return {.conservative = map_last * last_robot.conservative,
          .adapted = map_last * last_robot.adapted};
}

}  // namespace qwsm
