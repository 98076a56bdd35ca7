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
/// For every query it keeps the neighbour found when the tree was last searched, and a distance no
/// *other* point was nearer than. While
///   |q - neighbour| + path since then <= others,
/// the triangle inequality proves the neighbour unchanged and the tree is not touched. Otherwise
/// the search starts from the neighbour's leaf. For any motion the distances are those of brute
/// force.
class CachedSearch {
 public:
  /// Searches for the queries in a tree; both must outlive the search. Queries near each other
  /// should stand near each other.
  CachedSearch(const KdTree& tree, const PointCloud& queries, const CachedSearchOptions& options);

  /// Moves the queries to where they are by this pose in the frame of the tree.
  void MoveTo(const Pose3& T_tree_queries);

  /// Finds the neighbours of the queries [first, last), where they are. @pre they were moved there.
  /// Different ranges may be searched by different threads at a time, if blocks of eight are not
  /// torn apart.
  SearchStatistics Find(std::size_t first, std::size_t last);

  std::size_t size() const { return slot_.size(); }

  /// Query i where it is, in the frame of the tree, to the last bit as it was searched.
  Eigen::Vector3d query_m(std::size_t i) const;
  /// Whether query i has a neighbour nearer than the maximum distance.
  bool found(std::size_t i) const { return distance2_m2(i) < max_distance2_m2_; }
  double distance2_m2(std::size_t i) const;
  /// Place of query i's neighbour in the cloud. @pre found(i)
  std::size_t neighbor_index(std::size_t i) const {
    return tree_->layout().index_of_slot[slot_[i]];
  }
  /// Slot of query i's neighbour in the tree's layout. @pre found(i)
  std::uint32_t neighbor_slot(std::size_t i) const { return slot_[i]; }
  Eigen::Vector3d neighbor_m(std::size_t i) const { return neighbor_[i]; }

  /// The neighbours of all queries, stored by coordinate; infinity where none is known.
  const PointCloud& neighbors() const { return neighbor_; }
  double max_distance2_m2() const { return max_distance2_m2_; }

 private:
  void LayOutBlocks();

  const KdTree* tree_;
  const PointCloud* queries_;
  CachedSearchOptions options_;
  double max_distance2_m2_;
  Pose3 T_tree_queries_;
  bool is_placed_ = false;
  /// Blocks of eight queries: their middles, how far their queries are from them, and how far they
  /// have moved in all.
  PointCloud middles_;
  std::vector<double> radius_m_;
  std::vector<double> path_m_;
  PointCloud neighbor_;
  std::vector<float> others_m_;
  std::vector<std::uint32_t> slot_;
};

}  // namespace slam6d
