// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/cloud/scan_model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace slam6d {
namespace {

Eigen::Vector3d PointInSlot(const KdTreeLayout& layout, std::size_t slot) {
  const PointBlock& block = layout.blocks[slot / kLanes];
  return {block.x_m[slot % kLanes], block.y_m[slot % kLanes], block.z_m[slot % kLanes]};
}

std::optional<Surfel> FitSurfel(const KdTreeLayout& layout,
                                const KdNode& leaf,
                                const SurfelOptions& options) {
  if (leaf.point_count < static_cast<std::uint32_t>(options.min_points)) return std::nullopt;
  const std::size_t first = static_cast<std::size_t>(leaf.first) * kLanes;
  const double count = leaf.point_count;
  Surfel surfel;
  for (std::uint32_t i = 0; i < leaf.point_count; ++i) {
    surfel.mean_m += PointInSlot(layout, first + i) / count;
  }
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();
  for (std::uint32_t i = 0; i < leaf.point_count; ++i) {
    const Eigen::Vector3d offset_m = PointInSlot(layout, first + i) - surfel.mean_m;
    scatter_m2 += offset_m * offset_m.transpose() / count;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scatter_m2);
  const Eigen::Vector3d variances_m2 = eigen.eigenvalues().cwiseMax(0.0);
  if (!(variances_m2(0) < options.max_flatness * variances_m2(1))) return std::nullopt;
  surfel.normal = eigen.eigenvectors().col(0);
  surfel.variance_m2 = variances_m2(0) / count;
  return surfel;
}

PointCloud InTreeOrder(const PointCloud& cloud, const KdTree& tree) {
  PointCloud points;
  points.reserve(tree.layout().order.size());
  for (const std::uint32_t index : tree.layout().order) points.push_back(cloud[index]);
  return points;
}

}  // namespace

SurfelMap FindSurfels(const KdTree& tree, const SurfelOptions& options) {
  const KdTreeLayout& layout = tree.layout();
  SurfelMap map;
  map.surfel_of_block.assign(layout.blocks.size(), SurfelMap::kNone);
  // The blocks of a leaf follow each other, and the leaves stand in the order of the points.
  for (std::size_t block = 0; block < layout.blocks.size();) {
    const KdNode& leaf = layout.nodes[layout.leaf_of_block[block]];
    const std::size_t end = block + (leaf.point_count + kLanes - 1) / kLanes;
    if (const std::optional<Surfel> surfel = FitSurfel(layout, leaf, options)) {
      const auto number = static_cast<std::int32_t>(map.surfels.size());
      std::fill(map.surfel_of_block.begin() + static_cast<std::ptrdiff_t>(block),
                map.surfel_of_block.begin() + static_cast<std::ptrdiff_t>(end),
                number);
      map.surfels.push_back(*surfel);
    }
    block = end;
  }
  return map;
}

ScanModel::ScanModel(const PointCloud& cloud, const KdTreeOptions& options)
    : tree(cloud, options), points(InTreeOrder(cloud, tree)), surfels(FindSurfels(tree)) {}

}  // namespace slam6d
