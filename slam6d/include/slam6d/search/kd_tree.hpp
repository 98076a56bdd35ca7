// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/search/detail/kd_tree_layout.hpp"
#include "slam6d/search/simd_level.hpp"

namespace slam6d {

/// A point of the cloud and its squared distance from the query.
struct Neighbor {
  std::size_t index = 0;
  double distance2_m2 = 0.0;
};

/// What a number of searches cost.
struct SearchStatistics {
  std::uint64_t queries = 0;
  /// Leaves visited; eight queries searched together visit a leaf once.
  std::uint64_t leaves_visited = 0;
  /// Queries answered by the cache without touching the tree.
  std::uint64_t proven_unchanged = 0;
  std::uint64_t started_below_root = 0;  ///< Searches the cache let begin at a lower node.

  SearchStatistics& operator+=(const SearchStatistics& other);
};

struct KdTreeOptions {
  int bucket_size = 16;  ///< A node with more points is cut.
  SimdLevel simd = SimdLevel::kBest;
};

template <class Visitor>
void Describe(Visitor& visit, KdTreeOptions& o) {
  visit("bucket_size",
        o.bucket_size,
        {.help = "a node with more points is cut", .min = 1, .max = 1000});
  visit("simd", o.simd, {.help = "instructions of the searches; the results are the same"});
}

/// A kd-tree with buckets over a fixed cloud (Friedman, Bentley & Finkel 1977; Nüchter et al.
/// 2007, section 4): the longest side of the box of a node's points is cut at its middle.
///
/// Points that are not finite are left out; equal points are stored once, so that thousands of
/// copies cost nothing. Searching is const and safe from any number of threads. All distances
/// returned are those a comparison with every point gives, to the last bit.
class KdTree {
 public:
  /// Builds the tree in O(n log n). It copies the points; the cloud may go.
  explicit KdTree(const PointCloud& cloud, const KdTreeOptions& options = {});

  /// Number of different points.
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  SimdLevel simd() const { return simd_; }
  int bucket_size() const { return bucket_size_; }

  /// The nearest point nearer than `max_distance_m`, if there is one; the search begins at the
  /// root.
  std::optional<Neighbor> FindNearest(
      const Eigen::Vector3d& query_m,
      double max_distance_m = std::numeric_limits<double>::infinity(),
      SearchStatistics* statistics = nullptr) const;

  /// A point at most (1 + relative_error) times as far as the nearest one (Arya & Mount 1993).
  /// Nothing is found only if no point is nearer than `max_distance_m` / (1 + relative_error).
  std::optional<Neighbor> FindNearestApproximately(
      const Eigen::Vector3d& query_m,
      double relative_error,
      double max_distance_m = std::numeric_limits<double>::infinity(),
      SearchStatistics* statistics = nullptr) const;

  const KdTreeLayout& layout() const { return layout_; }

 private:
  KdTreeLayout layout_;
  std::size_t size_ = 0;
  int bucket_size_;
  SimdLevel simd_;
};

}  // namespace slam6d
