// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/spatial.hpp"

namespace qwsm::dds {
namespace {

using RowMajorMatrix6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

}  // namespace

wire::Pose ToWire(const slam6d::Pose3& pose) {
  const Eigen::Vector3d& t = pose.translation_m;
  const Eigen::Vector4d q = slam6d::QuaternionOf(pose.rotation);
  return {.position = {t.x(), t.y(), t.z()}, .orientation = {q.x(), q.y(), q.z(), q.w()}};
}

slam6d::Pose3 SpatialPose(const wire::Pose& pose) {
  const wire::Quaternion& q = pose.orientation;
  return {.rotation = slam6d::RotationFromQuaternion({q.x, q.y, q.z, q.w}),
          .translation_m = {pose.position.x, pose.position.y, pose.position.z}};
}

void CopyCovariance(const slam6d::Matrix6d& covariance, double (&of_six)[36]) {
  Eigen::Map<RowMajorMatrix6d>(of_six, 6, 6) = covariance;
}

slam6d::Matrix6d SpatialCovariance(const double (&of_six)[36]) {
  return Eigen::Map<const RowMajorMatrix6d>(of_six, 6, 6);
}

}  // namespace qwsm::dds
