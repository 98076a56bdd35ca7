// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d {

/// The place of a cube among all cubes of its size, counted along x, y and z.
using CubePlace = std::array<std::uint32_t, 3>;

/// An octree over a fixed cloud, kept as the sorted list of its smallest occupied cubes (a linear
/// octree, Gargantini 1982). The cube at level k that holds a cube of level 0 is found by halving
/// its place k times.
class Octree {
 public:
  /// Most cubes along an axis. For a wider cloud the smallest cube is doubled until they suffice
  /// for all but stray points; these are in the outermost cubes.
  static constexpr std::uint32_t kMaxCubes = 1U << 21U;

  /// Sorts the points into cubes in O(n log n); points that are not finite are left out.
  /// @param cube_m edge of the smallest cubes. @pre positive.
  Octree(const PointCloud& cloud, double cube_m);

  /// Number of the smallest cubes that hold points.
  std::size_t size() const { return places_.size(); }
  /// Edge of the cubes of a level, in metres; level 0 has the smallest.
  double cube_m(int level = 0) const { return cube_m_ * static_cast<double>(1U << level); }
  /// The corner from which cubes are counted.
  const Eigen::Vector3d& origin_m() const { return origin_m_; }

  const CubePlace& place(std::size_t cube) const { return places_[cube]; }
  /// Places in the cloud of the points in a smallest cube, ascending.
  std::span<const std::uint32_t> points(std::size_t cube) const {
    return std::span(points_).subspan(first_[cube], first_[cube + 1] - first_[cube]);
  }

 private:
  double cube_m_;
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();
  std::vector<CubePlace> places_;  ///< Cubes near each other stand near each other.
  /// Per cube, where its points begin in `points_`; then their end.
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> points_;  ///< Places in the cloud, cube by cube.
};

/// The place of the cube that holds a point. The point is not checked against the limits of an
/// octree.
/// @pre the point lies at or above `origin_m` on all axes, by less than kMaxCubes cubes.
CubePlace PlaceOf(const Eigen::Vector3d& point_m, const Eigen::Vector3d& origin_m, double cube_m);

}  // namespace slam6d
