// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Covariance of (x, y, theta), or information, along the axes of frame b instead of frame a.
inline Eigen::Matrix3d AlongAxesOf(const Pose2& T_a_b, const Eigen::Matrix3d& in_a) {
  Eigen::Matrix3d R_a_b = Eigen::Matrix3d::Identity();
  R_a_b.topLeftCorner<2, 2>() = T_a_b.Rotation();
  return R_a_b.transpose() * in_a * R_a_b;
}

}  // namespace qwsm
