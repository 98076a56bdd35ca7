// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// The symmetric matrix without its negative eigenvalues: what is left of a difference of
/// covariances.
Eigen::Matrix3d PositivePart(const Eigen::Matrix3d& difference);

/// Covariance of a small motion (x, y, theta) of a whole frame about its origin.
///
/// Poses that were displaced together, as by the drift of the map around them, share it wherever
/// they are, whereas the covariance of each pose depends on its place.
struct FrameCovariance {
  Eigen::Matrix3d about_origin = Eigen::Matrix3d::Zero();

  static FrameCovariance Of(const UncertainPose2& map_robot);
  /// Covariance of (x, y, theta) of a pose at the place.
  Eigen::Matrix3d At(const Eigen::Vector2d& p_m) const;
  /// Variance of the position of a point at the place, in m^2: the mean over both axes.
  double PositionVariance(const Eigen::Vector2d& p_m) const;
};

/// What is left of a pose's covariance beside a part that it shares with others; nothing is
/// negative.
UncertainPose2 Without(const FrameCovariance& part, const UncertainPose2& map_robot);

/// A pose of the map as seen from an earlier one, as uncertain as it is more than that one.
UncertainPose2 Since(const UncertainPose2& map_earlier, const UncertainPose2& map_robot);

/// The estimate about another pose than its own: as much more uncertain as that is apart from it.
UncertainPose2 About(const Pose2& T_a_b, const UncertainPose2& estimate);

/// How far two independent estimates of a pose are apart, squared, in units of what both may be off
/// by: chi-square of three degrees of freedom if they are of one pose.
double SquaredMahalanobisDistance(const UncertainPose2& a, const UncertainPose2& b);

}  // namespace qwsm
