// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace qwsm::io {

/// The half axes of the ellipse in which a position lies with 95 % probability, as columns, metres.
/// @param covariance of (x, y, theta); what is not a number or negative counts as no uncertainty.
Eigen::Matrix2d HalfAxes95(const Eigen::Matrix3d& covariance);

/// The outline of an ellipse; the last point is the first.
std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& center_m,
                                            const Eigen::Matrix2d& half_axes_m);

/// How much larger than they are ellipses of these sizes are drawn for most of them to be seen:
/// 1, 2, 5, 10, ... 1000.
double Enlargement(std::vector<double> radii_px);

}  // namespace qwsm::io
