// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/geometry/frame_covariance.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace qwsm {
namespace {

// How a pose at a place moves with a small motion (x, y, theta) of its frame about the origin.
Eigen::Matrix3d LeverOf(const Eigen::Vector2d& p_m) {
  Eigen::Matrix3d lever = Eigen::Matrix3d::Identity();
  lever(0, 2) = -p_m.y();
  lever(1, 2) = p_m.x();
  return lever;
}

}  // namespace

Eigen::Matrix3d PositivePart(const Eigen::Matrix3d& difference) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(difference);
  return axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).asDiagonal() *
         axes.eigenvectors().transpose();
}

FrameCovariance FrameCovariance::Of(const UncertainPose2& map_robot) {
  const Eigen::Matrix3d lever = LeverOf(-map_robot.T_a_b.translation_m());
  return {lever * map_robot.covariance * lever.transpose()};
}

Eigen::Matrix3d FrameCovariance::At(const Eigen::Vector2d& p_m) const {
  const Eigen::Matrix3d lever = LeverOf(p_m);
  return lever * about_origin * lever.transpose();
}

double FrameCovariance::PositionVariance(const Eigen::Vector2d& p_m) const {
  // The half trace of the first two rows and columns of At(), term by term.
  const Eigen::Matrix3d& c = about_origin;
  const double xx = (c(0, 0) - p_m.y() * c(2, 0)) + (c(0, 2) - p_m.y() * c(2, 2)) * -p_m.y();
  const double yy = (c(1, 1) + p_m.x() * c(2, 1)) + (c(1, 2) + p_m.x() * c(2, 2)) * p_m.x();
  return 0.5 * (xx + yy);
}

// Seen from where the robot is: about an origin that is far away, the rounding errors of the
// difference are larger.
UncertainPose2 Without(const FrameCovariance& part, const UncertainPose2& map_robot) {
  return {
      .T_a_b = map_robot.T_a_b,
      .covariance = PositivePart(map_robot.covariance - part.At(map_robot.T_a_b.translation_m()))};
}

UncertainPose2 Since(const UncertainPose2& map_earlier, const UncertainPose2& map_robot) {
  return UncertainPose2{.T_a_b = map_earlier.T_a_b.Inverse()} *
         Without(FrameCovariance::Of(map_earlier), map_robot);
}

UncertainPose2 About(const Pose2& T_a_b, const UncertainPose2& estimate) {
  const Eigen::Vector3d apart = Difference(estimate.T_a_b, T_a_b);
  return {.T_a_b = T_a_b, .covariance = estimate.covariance + apart * apart.transpose()};
}

double SquaredMahalanobisDistance(const UncertainPose2& a, const UncertainPose2& b) {
  const Eigen::Vector3d apart = Difference(a.T_a_b, b.T_a_b);
  return apart.dot((a.covariance + b.covariance).inverse() * apart);
}

}  // namespace qwsm
