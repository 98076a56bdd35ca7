// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/search/kd_tree.hpp"

namespace slam6d {

/// A flat piece of surface: the points of one leaf of the kd-tree.
struct Surfel {
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Points towards the scanner.
  /// Covariance of the normal: its small turns, seen as moves of its tip.
  Eigen::Matrix3d normal_covariance = Eigen::Matrix3d::Zero();
  /// Variance of the mean along the normal, from the scatter of the points.
  double variance_m2 = 0.0;
};

struct SurfelOptions {
  int min_points = 5;  ///< Leaves with fewer points give no surfel.
  /// A leaf gives a surfel if it is flat: its variance across, and that of most others, is at most
  /// this share of the next larger one.
  double max_flatness = 0.1;
};

/// The flat leaves of a tree over points in the scanner's frame. O(n): the tree has sorted the
/// points already, so that no search for the neighbours of every point is needed.
struct SurfelMap {
  static constexpr std::int32_t kNone = -1;

  std::vector<Surfel> surfels;
  std::vector<std::int32_t>
      surfel_of_block;  ///< Per block of the tree; kNone if its leaf is not flat.
};

SurfelMap FindSurfels(const KdTree& tree, const SurfelOptions& options = {});

/// A cloud made ready for registration, as reference and as current scan alike. It is in the
/// scanner's frame: from its origin the points were seen.
struct ScanModel {
  explicit ScanModel(const PointCloud& cloud, const KdTreeOptions& options = {});

  KdTree tree;
  PointCloud points;  ///< The finite points, leaf by leaf: neighbours stand near each other.
  SurfelMap surfels;
};

}  // namespace slam6d
