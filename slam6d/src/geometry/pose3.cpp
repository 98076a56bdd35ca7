// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/geometry/pose3.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

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
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(nearly, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

Pose3 ScaledMotion(const Pose3& motion, double share) {
  return {.rotation = RotationFromVector(share * RotationVector(motion.rotation)),
          .translation_m = share * motion.translation_m};
}

bool IsFinite(const Pose3& pose) {
  return pose.rotation.allFinite() && pose.translation_m.allFinite();
}

}  // namespace slam6d
