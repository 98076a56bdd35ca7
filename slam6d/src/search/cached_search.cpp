// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/search/cached_search.hpp"

#include <cassert>
#include <limits>

#include "slam6d/src/search/kd_tree_kernel.hpp"

namespace slam6d {
namespace {

constexpr double kBeyondAll_m = std::numeric_limits<double>::infinity();

/// A leaf of several points tells how far the second nearest is; a leaf of one does not. The search
/// then goes on to this multiple of the squared distance (kd_tree_bench: at bucket size 1 it halves
/// the time of a registration, from 4 on it only costs).
constexpr int kTellingBucket = 4;
constexpr double kLookBeyond = 1.5;

}  // namespace

CachedSearch::CachedSearch(const KdTree& tree,
                           std::size_t query_count,
                           const CachedSearchOptions& options)
    : tree_(&tree),
      options_(options),
      max_distance2_m2_(options.max_distance_m * options.max_distance_m),
      searched_(query_count),
      neighbor_(query_count),
      others_m_(query_count, -kBeyondAll_m),
      distance2_m2_(query_count, kBeyondAll_m),
      slot_(query_count, KdTreeLayout::kNoSlot) {}

SearchStatistics CachedSearch::Find(const PointCloud& queries,
                                    std::size_t first,
                                    std::size_t last) {
  assert(queries.size() == size() && last <= size() && "one remembered answer per query");
  if (tree_->empty()) return {.queries = last - first};
  const bool from_root = options_.start == SearchStart::kRoot;
  const bool looks_beyond = !from_root && tree_->bucket_size() < kTellingBucket;
  const RangeSearch range{
      .tree = ViewOf(tree_->layout()),
      .rules = {.max_distance_m = options_.max_distance_m,
                .prune_scale = looks_beyond ? kLookBeyond : 1.0,
                .from_root = from_root},
      .queries = {queries.x_m(), queries.y_m(), queries.z_m(), first, last},
      .cache = {.searched_x_m = searched_.x_m(),
                .searched_y_m = searched_.y_m(),
                .searched_z_m = searched_.z_m(),
                .others_m = others_m_.data(),
                .neighbor_x_m = neighbor_.x_m(),
                .neighbor_y_m = neighbor_.y_m(),
                .neighbor_z_m = neighbor_.z_m(),
                .distance2_m2 = distance2_m2_.data(),
                .slot = slot_.data()},
  };
  RangeCounts counts{};
  KernelFor(tree_->simd()).search_range(range, counts);
  return {.queries = last - first,
          .leaves_visited = counts.leaves_visited,
          .proven_unchanged = counts.proven_unchanged,
          .started_below_root = counts.started_below_root};
}

}  // namespace slam6d
