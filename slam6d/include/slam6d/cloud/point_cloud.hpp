// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// Points in one frame, in metres. Stored by coordinate, as the loops over many points need it.
class PointCloud {
 public:
  PointCloud() = default;
  explicit PointCloud(std::size_t size) : x_m_(size), y_m_(size), z_m_(size) {}

  std::size_t size() const { return x_m_.size(); }
  bool empty() const { return x_m_.empty(); }
  void reserve(std::size_t size);
  /// Drops the last points, or adds some at the origin.
  void resize(std::size_t size);
  void push_back(const Eigen::Vector3d& point_m);
  void Append(const PointCloud& other);

  Eigen::Vector3d operator[](std::size_t i) const { return {x_m_[i], y_m_[i], z_m_[i]}; }
  void Set(std::size_t i, const Eigen::Vector3d& point_m);

  const double* x_m() const { return x_m_.data(); }
  const double* y_m() const { return y_m_.data(); }
  const double* z_m() const { return z_m_.data(); }
  double* x_m() { return x_m_.data(); }
  double* y_m() { return y_m_.data(); }
  double* z_m() { return z_m_.data(); }

 private:
  std::vector<double> x_m_;
  std::vector<double> y_m_;
  std::vector<double> z_m_;
};

/// The points in frame a of a cloud given in frame b.
PointCloud operator*(const Pose3& T_a_b, const PointCloud& cloud_b);

/// Writes the points [first, last) of `cloud_b`, mapped to frame a, to the same places of
/// `cloud_a`.
/// @pre both clouds have at least `last` points.
void TransformRange(const Pose3& T_a_b,
                    const PointCloud& cloud_b,
                    std::size_t first,
                    std::size_t last,
                    PointCloud& cloud_a);

/// The points whose distance from the origin lies in [min_range_m, max_range_m]: a scanner writes
/// "no echo" as a range near its maximum. Points that are not numbers are dropped as well.
PointCloud InRange(const PointCloud& cloud, double min_range_m, double max_range_m);

}  // namespace slam6d
