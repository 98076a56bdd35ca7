// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam6d/cloud/point_cloud.hpp"
#include "slam6d/search/kd_tree.hpp"

namespace slam6d {

/// Says where the searches of later iterations begin.
enum class SearchStart {
  kCache,  ///< At the leaf of the last neighbour (Nüchter et al. 2007, section 4.1).
  kRoot,   ///< At the root, as if every iteration were the first: the yardstick.
};

struct CachedSearchOptions {
  double max_distance_m = std::numeric_limits<double>::infinity();
  SearchStart start = SearchStart::kCache;
};

/// The nearest neighbours of a cloud that moves a little between calls: the cached kd-tree search
/// of Nüchter et al. (2007), section 4.1.
///
/// For every query it keeps where the query was when the tree was last searched, the neighbour
/// found then, and a distance no *other* point was nearer than. While
///   |q - neighbour| + |q - q_then| <= others,
/// the triangle inequality proves the neighbour unchanged and the tree is not touched. Otherwise
/// the search starts from the neighbour's leaf. For any motion the distances are those of brute
/// force.
class CachedSearch {
 public:
  /// Searches for `query_count` queries in a tree, which must outlive the search.
  CachedSearch(const KdTree& tree, std::size_t query_count, const CachedSearchOptions& options);

  /// Finds the neighbours of the queries [first, last). Different ranges may be searched by
  /// different threads at a time. Queries near each other should stand near each other.
  SearchStatistics Find(const PointCloud& queries, std::size_t first, std::size_t last);

  std::size_t size() const { return slot_.size(); }

  /// Whether query i has a neighbour nearer than the maximum distance.
  bool found(std::size_t i) const { return distance2_m2_[i] < max_distance2_m2_; }
  double distance2_m2(std::size_t i) const { return distance2_m2_[i]; }
  /// Place of query i's neighbour in the cloud. @pre found(i)
  std::size_t neighbor_index(std::size_t i) const {
    return tree_->layout().index_of_slot[slot_[i]];
  }
  /// Slot of query i's neighbour in the tree's layout. @pre found(i)
  std::uint32_t neighbor_slot(std::size_t i) const { return slot_[i]; }
  Eigen::Vector3d neighbor_m(std::size_t i) const { return neighbor_[i]; }

  /// The neighbours of all queries, stored by coordinate; infinity where none is known.
  const PointCloud& neighbors() const { return neighbor_; }
  const double* distances2_m2() const { return distance2_m2_.data(); }
  double max_distance2_m2() const { return max_distance2_m2_; }

 private:
  const KdTree* tree_;
  CachedSearchOptions options_;
  double max_distance2_m2_;
  PointCloud searched_;
  PointCloud neighbor_;
  std::vector<double> others_m_;
  std::vector<double> distance2_m2_;
  std::vector<std::uint32_t> slot_;
};

}  // namespace slam6d
