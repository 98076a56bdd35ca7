// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace qwsm {

/// Variances of a planar distribution along its principal axes.
struct PrincipalAxes {
  double minor_m2 = 0.0;
  double major_m2 = 0.0;
  Eigen::Vector2d minor_axis = Eigen::Vector2d::UnitX();  ///< Unit vector of the minor variance.
};

/// Closed-form eigendecomposition of the covariance [xx xy; xy yy].
inline PrincipalAxes PrincipalAxesOf(double xx, double xy, double yy) {
  const double half_sum = 0.5 * (xx + yy);
  const double half_difference = 0.5 * (xx - yy);
  const double radius = std::sqrt(half_difference * half_difference + xy * xy);
  PrincipalAxes axes;
  axes.minor_m2 = std::max(0.0, half_sum - radius);
  axes.major_m2 = std::max(0.0, half_sum + radius);
  // Of the two columns of (C - major I), which both lie along the minor axis, the longer is exact.
  const Eigen::Vector2d a = half_difference > 0.0 ? Eigen::Vector2d(-xy, half_difference + radius)
                                                  : Eigen::Vector2d(half_difference - radius, xy);
  const double norm = a.norm();
  if (norm > 0.0) axes.minor_axis = a * (1.0 / norm);
  return axes;
}

}  // namespace qwsm
