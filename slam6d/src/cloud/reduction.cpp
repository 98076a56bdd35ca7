// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/cloud/reduction.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "slam6d/cloud/octree.hpp"

namespace slam6d {
namespace {

using Points = std::span<const std::uint32_t>;

Eigen::Vector3d Mean(const PointCloud& cloud, Points points) {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : points) sum_m += cloud[i];
  return sum_m / static_cast<double>(points.size());
}

Eigen::Vector3d NearestToMean(const PointCloud& cloud, Points points) {
  const Eigen::Vector3d mean_m = Mean(cloud, points);
  const auto distance2_m2 = [&](std::uint32_t i) { return (cloud[i] - mean_m).squaredNorm(); };
  return cloud[*std::ranges::min_element(points, {}, distance2_m2)];
}

/// The standard leaves std::sample and its distributions open; this is the same everywhere.
class Draw {
 public:
  explicit Draw(int seed) : random_(static_cast<std::uint32_t>(seed)) {}

  /// Appends `count` of the points, or all if there are no more.
  void Append(const PointCloud& cloud, Points points, int count, PointCloud& kept) {
    left_.assign(points.begin(), points.end());
    for (int drawn = 0; drawn < count && !left_.empty(); ++drawn) {
      std::swap(left_[random_() % left_.size()], left_.back());
      kept.push_back(cloud[left_.back()]);
      left_.pop_back();
    }
  }

 private:
  std::mt19937 random_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

PointCloud Reduce(const PointCloud& cloud, const ReductionOptions& options) {
  if (options.voxel_m <= 0.0) return cloud;
  const Octree octree(cloud, options.voxel_m);
  PointCloud kept;
  kept.reserve(octree.size());
  Draw draw(options.seed);
  for (std::size_t cube = 0; cube < octree.size(); ++cube) {
    switch (options.keep) {
      case ReductionChoice::kMean:
        kept.push_back(Mean(cloud, octree.points(cube)));
        break;
      case ReductionChoice::kNearestToMean:
        kept.push_back(NearestToMean(cloud, octree.points(cube)));
        break;
      case ReductionChoice::kRandom:
        draw.Append(cloud, octree.points(cube), options.points_per_voxel, kept);
        break;
    }
  }
  return kept;
}

}  // namespace slam6d
