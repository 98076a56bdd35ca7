// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/geometry/pose3.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "slam6d/src/algebra/svd.hpp"

namespace slam6d {

Pose3 Pose3::Inverse() const {
  return {.rotation = rotation.transpose(),
          .translation_m = -(rotation.transpose() * translation_m)};
}

Pose3 operator*(const Pose3& T_a_b, const Pose3& T_b_c) {
  return {.rotation = T_a_b.rotation * T_b_c.rotation,
          .translation_m = T_a_b * T_b_c.translation_m};
}

Eigen::Vector3d operator*(const Pose3& T_a_b, const Eigen::Vector3d& p_b_m) {
  return T_a_b.rotation * p_b_m + T_a_b.translation_m;
}

Eigen::Matrix3d Skew(const Eigen::Vector3d& a) {
  return Eigen::Matrix3d{{0.0, -a.z(), a.y()}, {a.z(), 0.0, -a.x()}, {-a.y(), a.x(), 0.0}};
}

Matrix6d BlockRotation(const Eigen::Matrix3d& R) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = R;
  both.bottomRightCorner<3, 3>() = R;
  return both;
}

Eigen::Matrix3d RotationFromVector(const Eigen::Vector3d& rotation_vector_rad) {
  const double angle_rad = rotation_vector_rad.norm();
  if (angle_rad == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, rotation_vector_rad / angle_rad).toRotationMatrix();
}

Eigen::Vector3d RotationVector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd angle_axis(rotation);
  return angle_axis.angle() * angle_axis.axis();
}

double RotationAngle(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2.0 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

Eigen::Matrix3d RotationFromRollPitchYaw(const Eigen::Vector3d& roll_pitch_yaw_rad) {
  return (Eigen::AngleAxisd(roll_pitch_yaw_rad.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(roll_pitch_yaw_rad.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_pitch_yaw_rad.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& rotation) {
  const double pitch_rad = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
  const double cos_pitch = std::hypot(rotation(2, 1), rotation(2, 2));
  if (cos_pitch < 1e-12) {  // Gimbal lock: only the sum of roll and yaw is defined; roll becomes 0.
    return {0.0, pitch_rad, std::atan2(-rotation(0, 1), rotation(1, 1))};
  }
  return {std::atan2(rotation(2, 1), rotation(2, 2)),
          std::atan2(-rotation(2, 0), cos_pitch),
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& nearly) {
  Svd3 svd = SvdOf(nearly);
  if ((svd.U * svd.V.transpose()).determinant() < 0.0) svd.U.col(2) = -svd.U.col(2);
  return svd.U * svd.V.transpose();
}

// Three components on a grid that is coarse beside the rounding of what makes a quaternion of a
// matrix; the fourth, one of the large ones, follows from them.
Eigen::Matrix3d RotationFromQuaternion(const Eigen::Vector4d& xyzw) {
  constexpr double kGrid = 0x1p-47;
  constexpr double kLarge = 0.49;  // One is 0.5 at least; a quarter turn is no borderline case.
  Eigen::Vector4d q = xyzw.normalized();
  if (!(q.squaredNorm() > kLarge)) return Eigen::Matrix3d::Constant(std::nan(""));
  Eigen::Index last = 3;
  while (std::abs(q(last)) < kLarge) --last;
  q = (q * std::copysign(1.0 / kGrid, q(last))).array().round() * kGrid;
  q(last) = 0.0;
  q(last) = std::sqrt(1.0 - q.squaredNorm());
  return Eigen::Quaterniond(q).toRotationMatrix();
}

Eigen::Vector4d QuaternionOf(const Eigen::Matrix3d& rotation) {
  return Eigen::Quaterniond(rotation).coeffs();
}

Pose3 ScaledMotion(const Pose3& motion, double share) {
  return {.rotation = RotationFromVector(share * RotationVector(motion.rotation)),
          .translation_m = share * motion.translation_m};
}

Vector6d Difference(const Pose3& a, const Pose3& b) {
  Vector6d difference;
  difference << a.translation_m - b.translation_m,
      RotationVector(a.rotation * b.rotation.transpose());
  return difference;
}

bool IsFinite(const Pose3& pose) {
  return pose.rotation.allFinite() && pose.translation_m.allFinite();
}

UncertainPose3 operator*(const UncertainPose3& a_b, const UncertainPose3& b_c) {
  UncertainPose3 a_c{.T_a_b = a_b.T_a_b * b_c.T_a_b};
  Matrix6d by_b = Matrix6d::Identity();  // A turn of b moves c on a lever.
  by_b.topRightCorner<3, 3>() = -Skew(a_c.T_a_b.translation_m - a_b.T_a_b.translation_m);
  const Matrix6d by_c = BlockRotation(a_b.T_a_b.rotation);
  a_c.covariance =
      by_b * a_b.covariance * by_b.transpose() + by_c * b_c.covariance * by_c.transpose();
  return a_c;
}

}  // namespace slam6d
