// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/pose2.hpp"

#include <cmath>

namespace qwsm {

Eigen::Matrix2d Pose2::Rotation() const {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}

Pose2 Pose2::Inverse() const {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  return {-c * x_m - s * y_m, s * x_m - c * y_m, NormalizeAngle(-theta_rad)};
}

Pose2 operator*(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d p_a_c = T_a_b * T_b_c.translation_m();
  return {p_a_c.x(), p_a_c.y(), NormalizeAngle(T_a_b.theta_rad + T_b_c.theta_rad)};
}

Eigen::Vector2d operator*(const Pose2& T_a_b, const Eigen::Vector2d& p_b_m) {
  const double c = std::cos(T_a_b.theta_rad);
  const double s = std::sin(T_a_b.theta_rad);
  return {T_a_b.x_m + c * p_b_m.x() - s * p_b_m.y(), T_a_b.y_m + s * p_b_m.x() + c * p_b_m.y()};
}

Pose2 Between(const Pose2& a, const Pose2& b, double share) {
  const double turn_rad = NormalizeAngle(b.theta_rad - a.theta_rad);
  return {.x_m = a.x_m + share * (b.x_m - a.x_m),
          .y_m = a.y_m + share * (b.y_m - a.y_m),
          .theta_rad = NormalizeAngle(a.theta_rad + share * turn_rad)};
}

Pose2 WithTurn(const Pose2& motion, double turn_rad) {
  const Pose2 half{.theta_rad = 0.5 * NormalizeAngle(turn_rad - motion.theta_rad)};
  const Eigen::Vector2d way_m = half * motion.translation_m();
  return {way_m.x(), way_m.y(), NormalizeAngle(turn_rad)};
}

bool IsFinite(const Pose2& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.theta_rad);
}

UncertainPose2 UncertainPose2::WithSigmas(const Pose2& T_a_b, double sigma_m, double sigma_rad) {
  UncertainPose2 uncertain{.T_a_b = T_a_b};
  uncertain.covariance.diagonal() = Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2();
  return uncertain;
}

double UncertainPose2::SigmaXY_m() const {
  return std::sqrt(0.5 * (covariance(0, 0) + covariance(1, 1)));
}

double UncertainPose2::SigmaTheta_rad() const { return std::sqrt(covariance(2, 2)); }

UncertainPose2 UncertainPose2::Inflated(double factor) const {
  return {.T_a_b = T_a_b, .covariance = factor * factor * covariance};
}

UncertainPose2 operator*(const UncertainPose2& a_b, const UncertainPose2& b_c) {
  const Eigen::Matrix2d R_a_b = a_b.T_a_b.Rotation();
  const Eigen::Vector2d arm_a = R_a_b * b_c.T_a_b.translation_m();
  Eigen::Matrix3d J_ab = Eigen::Matrix3d::Identity();
  J_ab(0, 2) = -arm_a.y();
  J_ab(1, 2) = arm_a.x();
  Eigen::Matrix3d J_bc = Eigen::Matrix3d::Identity();
  J_bc.topLeftCorner<2, 2>() = R_a_b;
  return {.T_a_b = a_b.T_a_b * b_c.T_a_b,
          .covariance =
              J_ab * a_b.covariance * J_ab.transpose() + J_bc * b_c.covariance * J_bc.transpose()};
}

}  // namespace qwsm
