// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/search/cached_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "slam6d/src/search/kernel_views.hpp"

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
                           const PointCloud& queries,
                           const CachedSearchOptions& options)
    : tree_(&tree),
      queries_(&queries),
      options_(options),
      max_distance2_m2_(options.max_distance_m * options.max_distance_m),
      neighbor_(queries.size()),
      others_m_(queries.size() + kPathBlock, -std::numeric_limits<float>::infinity()),
      slot_(queries.size(), KdTreeLayout::kNoSlot) {
  for (std::size_t i = 0; i < size(); ++i)
    neighbor_.Set(i, Eigen::Vector3d::Constant(kBeyondAll_m));
  LayOutBlocks();
}

void CachedSearch::LayOutBlocks() {
  const std::size_t size = queries_->size();
  for (std::size_t first = 0; first < size; first += kPathBlock) {
    const std::size_t last = std::min(size, first + kPathBlock);
    Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
    for (std::size_t i = first; i < last; ++i) {
      middle_m += (*queries_)[i] / static_cast<double>(last - first);
    }
    double radius2_m2 = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      radius2_m2 = std::max(radius2_m2, ((*queries_)[i] - middle_m).squaredNorm());
    }
    middles_.push_back(middle_m);
    radius_m_.push_back(std::sqrt(radius2_m2));
  }
  path_m_.assign(radius_m_.size(), 0.0);
}

Eigen::Vector3d CachedSearch::query_m(std::size_t i) const {
  const Eigen::Matrix3d& R = T_tree_queries_.rotation;
  const Eigen::Vector3d p_m = (*queries_)[i];
  // Not as a product of matrices, which may add up in another order.
  const Eigen::Vector3d turned_m = R.col(0) * p_m.x() + R.col(1) * p_m.y() + R.col(2) * p_m.z();
  return turned_m + T_tree_queries_.translation_m;
}

double CachedSearch::distance2_m2(std::size_t i) const {
  const Eigen::Vector3d apart_m = neighbor_[i] - query_m(i);
  return apart_m.x() * apart_m.x() + apart_m.y() * apart_m.y() + apart_m.z() * apart_m.z();
}

void CachedSearch::MoveTo(const Pose3& T_tree_queries) {
  const Pose3 before = std::exchange(T_tree_queries_, T_tree_queries);
  if (!std::exchange(is_placed_, true)) return;  // That was no motion.
  const Pose3 change{.rotation = T_tree_queries.rotation - before.rotation,
                     .translation_m = T_tree_queries.translation_m - before.translation_m};
  const double magnitude_m =
      T_tree_queries.translation_m.lpNorm<1>() + before.translation_m.lpNorm<1>();
  const PathView paths{.middles = ViewOf(middles_),
                       .radius_m = radius_m_.data(),
                       .path_m = path_m_.data(),
                       .count = path_m_.size()};
  KernelFor(tree_->simd()).lengthen_paths(paths, ViewOf(change), magnitude_m);
}

SearchStatistics CachedSearch::Find(std::size_t first, std::size_t last) {
  assert(last <= size() && "one remembered answer per query");
  assert(is_placed_ && "the queries are somewhere");
  if (tree_->empty()) return {.queries = last - first};
  const bool from_root = options_.start == SearchStart::kRoot;
  const bool looks_beyond = !from_root && tree_->bucket_size() < kTellingBucket;
  const RangeSearch range{
      .tree = ViewOf(tree_->layout()),
      .rules = {.max_distance_m = options_.max_distance_m,
                .prune_scale = looks_beyond ? kLookBeyond : 1.0,
                .from_root = from_root},
      .queries = ViewOf(*queries_),
      .T_tree_queries = ViewOf(T_tree_queries_),
      .cache = {.others_m = others_m_.data(),
                .neighbor_x_m = neighbor_.x_m(),
                .neighbor_y_m = neighbor_.y_m(),
                .neighbor_z_m = neighbor_.z_m(),
                .slot = slot_.data(),
                .path_m = path_m_.data()},
      .first = first,
      .last = last,
  };
  RangeCounts counts{};
  KernelFor(tree_->simd()).search_range(range, counts);
  return {.queries = last - first,
          .leaves_visited = counts.leaves_visited,
          .proven_unchanged = counts.proven_unchanged,
          .started_below_root = counts.started_below_root};
}

}  // namespace slam6d
