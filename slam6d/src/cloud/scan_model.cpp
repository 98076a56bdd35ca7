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

/// The points of a leaf, by their mean and how they scatter about it.
struct Patch {
  double count = 0.0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< Of the scatter, as columns.
  /// Along the axes, the smallest first: across the patch.
  Eigen::Vector3d variances_m2 = Eigen::Vector3d::Zero();
};

std::optional<Patch> FitPatch(const KdTreeLayout& layout,
                              const KdNode& leaf,
                              const SurfelOptions& options) {
  if (leaf.point_count < static_cast<std::uint32_t>(options.min_points)) return std::nullopt;
  const std::size_t first = static_cast<std::size_t>(leaf.first) * kLanes;
  Patch patch;
  patch.count = static_cast<double>(leaf.point_count);
  for (std::uint32_t i = 0; i < leaf.point_count; ++i) {
    patch.mean_m += PointInSlot(layout, first + i) / patch.count;
  }
  Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();
  for (std::uint32_t i = 0; i < leaf.point_count; ++i) {
    const Eigen::Vector3d offset_m = PointInSlot(layout, first + i) - patch.mean_m;
    scatter_m2 += offset_m * offset_m.transpose() / patch.count;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(scatter_m2);
  patch.axes = eigen.eigenvectors();
  patch.variances_m2 = eigen.eigenvalues().cwiseMax(0.0);
  return patch;
}

/// A patch is flat where it is thin beside its extent.
bool IsFlat(const Patch& patch, double thickness2_m2, const SurfelOptions& options) {
  return thickness2_m2 < options.max_flatness * patch.variances_m2(1);
}

/// How thick flat patches usually are, squared: the noise of the scanner.
double UsualThickness2(const std::vector<std::optional<Patch>>& patches,
                       const SurfelOptions& options) {
  std::vector<double> thickness2_m2;
  for (const std::optional<Patch>& patch : patches) {
    if (!patch || !IsFlat(*patch, patch->variances_m2(0), options)) continue;
    thickness2_m2.push_back(patch->variances_m2(0));
  }
  if (thickness2_m2.empty()) return 0.0;
  const auto middle = thickness2_m2.begin() + static_cast<std::ptrdiff_t>(thickness2_m2.size() / 2);
  std::nth_element(thickness2_m2.begin(), middle, thickness2_m2.end());
  return *middle;
}

/// The surface that a patch samples: its noise is its thickness across.
Surfel SurfelOf(const Patch& patch, double thickness2_m2) {
  Surfel surfel;
  surfel.mean_m = patch.mean_m;
  surfel.normal = patch.axes.col(0);
  if (surfel.normal.dot(surfel.mean_m) > 0.0) surfel.normal = -surfel.normal;
  surfel.variance_m2 = thickness2_m2 / patch.count;
  // First-order perturbation of the eigenvector across (Kanatani 1996).
  for (int axis = 1; axis < 3; ++axis) {
    const Eigen::Vector3d along = patch.axes.col(axis);
    const double variance = surfel.variance_m2 / std::max(patch.variances_m2(axis), 1e-300);
    surfel.normal_covariance += variance * along * along.transpose();
  }
  return surfel;
}

PointCloud InTreeOrder(const PointCloud& cloud, const KdTree& tree) {
  PointCloud points;
  points.reserve(tree.layout().order.size());
  for (const std::uint32_t index : tree.layout().order) points.push_back(cloud[index]);
  return points;
}

/// The blocks of every leaf, in the order of the points: those of a leaf follow each other.
std::vector<std::size_t> FirstBlocks(const KdTreeLayout& layout) {
  std::vector<std::size_t> first_blocks;
  for (std::size_t block = 0; block < layout.blocks.size();) {
    first_blocks.push_back(block);
    block += (layout.nodes[layout.leaf_of_block[block]].point_count + kLanes - 1) / kLanes;
  }
  return first_blocks;
}

}  // namespace

SurfelMap FindSurfels(const KdTree& tree, const SurfelOptions& options) {
  const KdTreeLayout& layout = tree.layout();
  const std::vector<std::size_t> first_blocks = FirstBlocks(layout);
  std::vector<std::optional<Patch>> patches;
  patches.reserve(first_blocks.size());
  for (const std::size_t block : first_blocks) {
    patches.push_back(FitPatch(layout, layout.nodes[layout.leaf_of_block[block]], options));
  }
  const double usual2_m2 = UsualThickness2(patches, options);
  SurfelMap map;
  map.surfel_of_block.assign(layout.blocks.size(), SurfelMap::kNone);
  for (std::size_t leaf = 0; leaf < patches.size(); ++leaf) {
    const std::optional<Patch>& patch = patches[leaf];
    if (!patch) continue;
    // A few points are flatter than the noise by chance, and patches close to the scanner smaller.
    const double thickness2_m2 = std::max(patch->variances_m2(0), usual2_m2);
    if (!IsFlat(*patch, thickness2_m2, options)) continue;
    const std::size_t end =
        leaf + 1 < first_blocks.size() ? first_blocks[leaf + 1] : layout.blocks.size();
    std::fill(map.surfel_of_block.begin() + static_cast<std::ptrdiff_t>(first_blocks[leaf]),
              map.surfel_of_block.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<std::int32_t>(map.surfels.size()));
    map.surfels.push_back(SurfelOf(*patch, thickness2_m2));
  }
  return map;
}

ScanModel::ScanModel(const PointCloud& cloud, const KdTreeOptions& options)
    : tree(cloud, options), points(InTreeOrder(cloud, tree)), surfels(FindSurfels(tree)) {}

}  // namespace slam6d
