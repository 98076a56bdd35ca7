// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/geometry/angle.hpp"

namespace qwsm {

/// A rigid motion of the plane, SE(2). `T_a_b` is the pose of frame b in frame a; it maps
/// coordinates in b to coordinates in a: `p_a = T_a_b * p_b`.
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;  ///< Counter-clockwise, in (-pi, pi].

  Eigen::Vector2d translation_m() const { return {x_m, y_m}; }
  Eigen::Matrix2d Rotation() const;
  Pose2 Inverse() const;

  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// T_a_c = T_a_b * T_b_c.
Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c);

/// p_a = T_a_b * p_b, in metres.
Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b_m);

/// Number by number: (x, y, theta) of the first less that of the second, as covariances are of.
inline Eigen::Vector3d Difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, NormalizeAngle(a.theta_rad - b.theta_rad)};
}

/// The pose of which that is the difference to another one.
inline Pose2 Shifted(const Pose2& pose, const Eigen::Vector3d& difference) {
  return {pose.x_m + difference.x(),
          pose.y_m + difference.y(),
          NormalizeAngle(pose.theta_rad + difference.z())};
}

/// The pose at `share` of the way from a (0) to b (1): straight ahead, turning the shorter way
/// round.
Pose2 Between(const Pose2& a, const Pose2& b, double share);

/// The motion with another turn, along an arc as long.
Pose2 WithTurn(const Pose2& motion, double turn_rad);

/// Whether all three numbers are finite.
bool IsFinite(const Pose2& pose);

/// A pose made ready to map many points: its sine and cosine are computed once.
struct RigidTransform2 {
  explicit RigidTransform2(const Pose2& T_a_b)
      : R_a_b(T_a_b.Rotation()), t_a_b_m(T_a_b.translation_m()) {}

  /// p_a = T_a_b * p_b, in metres.
  Eigen::Vector2d operator*(const Eigen::Vector2d& p_b_m) const { return R_a_b * p_b_m + t_a_b_m; }

  Eigen::Matrix2d R_a_b;    ///< Turns directions of frame b into frame a.
  Eigen::Vector2d t_a_b_m;  ///< The origin of frame b in frame a.
};

/// A pose and how far it may be from the truth.
///
/// `covariance` is of (x, y, theta) in m^2, m rad and rad^2, the translation along the axes of the
/// parent frame a, the rotation about the origin of b.
struct UncertainPose2 {
  Pose2 T_a_b;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// A pose known to these standard deviations: the first of x and of y, the second of the heading;
  /// their errors are independent of each other.
  static UncertainPose2 WithSigmas(const Pose2& T_a_b, double sigma_m, double sigma_rad);

  double SigmaXY_m() const;  ///< Sigma of the position: the root of the mean variance of both axes.
  double SigmaTheta_rad() const;
  /// Returns the same pose with all sigmas multiplied.
  UncertainPose2 Inflated(double factor) const;
};

/// Composes two poses with independent errors, to first order (Smith & Cheeseman 1986).
UncertainPose2 operator*(const UncertainPose2& a_b, const UncertainPose2& b_c);

}  // namespace qwsm
