// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/cloud/point_cloud.hpp"

#include <cassert>

namespace slam6d {

void PointCloud::reserve(std::size_t size) {
  x_m_.reserve(size);
  y_m_.reserve(size);
  z_m_.reserve(size);
}

void PointCloud::resize(std::size_t size) {
  x_m_.resize(size);
  y_m_.resize(size);
  z_m_.resize(size);
}

void PointCloud::push_back(const Eigen::Vector3d& point_m) {
  x_m_.push_back(point_m.x());
  y_m_.push_back(point_m.y());
  z_m_.push_back(point_m.z());
}

void PointCloud::Append(const PointCloud& other) {
  x_m_.insert(x_m_.end(), other.x_m_.begin(), other.x_m_.end());
  y_m_.insert(y_m_.end(), other.y_m_.begin(), other.y_m_.end());
  z_m_.insert(z_m_.end(), other.z_m_.begin(), other.z_m_.end());
}

void PointCloud::Set(std::size_t i, const Eigen::Vector3d& point_m) {
  x_m_[i] = point_m.x();
  y_m_[i] = point_m.y();
  z_m_[i] = point_m.z();
}

PointCloud operator*(const Pose3& T_a_b, const PointCloud& cloud_b) {
  PointCloud cloud_a(cloud_b.size());
  TransformRange(T_a_b, cloud_b, 0, cloud_b.size(), cloud_a);
  return cloud_a;
}

void TransformRange(const Pose3& T_a_b,
                    const PointCloud& cloud_b,
                    std::size_t first,
                    std::size_t last,
                    PointCloud& cloud_a) {
  assert(last <= cloud_b.size() && last <= cloud_a.size() && "range beyond the clouds");
  const Eigen::Matrix3d R = T_a_b.rotation;
  const Eigen::Vector3d t = T_a_b.translation_m;
  for (std::size_t i = first; i < last; ++i) {
    const double x = cloud_b.x_m()[i];
    const double y = cloud_b.y_m()[i];
    const double z = cloud_b.z_m()[i];
    cloud_a.x_m()[i] = R(0, 0) * x + R(0, 1) * y + R(0, 2) * z + t.x();
    cloud_a.y_m()[i] = R(1, 0) * x + R(1, 1) * y + R(1, 2) * z + t.y();
    cloud_a.z_m()[i] = R(2, 0) * x + R(2, 1) * y + R(2, 2) * z + t.z();
  }
}

PointCloud InRange(const PointCloud& cloud, double min_range_m, double max_range_m) {
  PointCloud kept(cloud.size());
  double* const x_m = kept.x_m();
  double* const y_m = kept.y_m();
  double* const z_m = kept.z_m();
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point_m = cloud[i];
    const double range2_m2 = point_m.squaredNorm();
    // Written in any case, and kept if it counts: nearly all do.
    x_m[count] = point_m.x();
    y_m[count] = point_m.y();
    z_m[count] = point_m.z();
    const bool is_near = range2_m2 <= max_range_m * max_range_m;
    count += is_near && range2_m2 >= min_range_m * min_range_m ? 1 : 0;
  }
  kept.resize(count);
  return kept;
}

}  // namespace slam6d
