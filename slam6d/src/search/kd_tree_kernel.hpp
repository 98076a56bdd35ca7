// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the searches ask of the innermost loops, which are compiled once per SimdLevel from
// kd_tree_kernel.inc. Plain structs and pointers only: a library template instantiated in those
// files could be linked into the rest of the program and fail on machines without the instructions.
#pragma once

#include <cstddef>
#include <cstdint>

#include "slam6d/search/detail/kd_tree_layout.hpp"
#include "slam6d/search/simd_level.hpp"

namespace slam6d {

/// Views the arrays of a KdTreeLayout.
struct KdTreeView {
  const KdNode* nodes;
  const Box* limits;
  const Box* cells;
  const PointBlock* blocks;
  const std::uint32_t* leaf_of_block;
};

/// One search. A subtree is left out when its squared distance is at least that of the best point
/// so far times `prune_scale`; a scale below 1 makes the search approximate.
struct SearchRequest {
  double query_m[3];
  std::uint32_t start_node;  ///< Nothing outside its cell can be the answer.
  double limit2_m2;          ///< Points farther than this are of no interest.
  std::uint32_t known_slot;  ///< A point known to be at `limit2_m2`, or kNoSlot.
  double prune_scale = 1.0;
};

struct SearchAnswer {
  double distance2_m2;  ///< `limit2_m2` when nothing is nearer.
  std::uint32_t slot;   ///< `known_slot` when nothing is nearer.
  double others2_m2;    ///< No other point in the start node's cell is nearer than this.
  std::uint32_t leaves_visited;
};

/// Views what CachedSearch remembers of its queries.
struct CacheView {
  double* searched_x_m;
  double* searched_y_m;
  double* searched_z_m;
  double* others_m;
  double* neighbor_x_m;
  double* neighbor_y_m;
  double* neighbor_z_m;
  double* distance2_m2;
  std::uint32_t* slot;
};

struct QueryRange {
  const double* x_m;
  const double* y_m;
  const double* z_m;
  std::size_t first;
  std::size_t last;
};

struct CacheRules {
  double max_distance_m;
  double prune_scale;  ///< Above 1: looks farther than the neighbour, to learn about the others.
  bool from_root;      ///< Forgets the cache: the yardstick.
};

struct RangeCounts {
  std::uint64_t leaves_visited;
  std::uint64_t proven_unchanged;
  std::uint64_t started_below_root;
};

/// One call of CachedSearch::Find.
struct RangeSearch {
  KdTreeView tree;
  CacheRules rules;
  QueryRange queries;
  CacheView cache;
};

/// Pairs (m_i, d_i) by coordinate, both in the frame ref.
struct PairRange {
  const double* ref_m[3];
  const double* cur_m[3];
  const double* distance2_m2;
  double max_distance2_m2;  ///< Pairs as far apart as this do not count.
  double origin_m[3];       ///< Subtracted from all points, against cancellation.
  std::size_t first;
  std::size_t last;
};

/// Number, squared distances, m (3), d (3), d m^T (9, by rows).
struct PairSums {
  static constexpr int kCount = 17;
  double value[kCount];
};

/// The loops of one SimdLevel.
struct KdTreeKernel {
  void (*search)(const KdTreeView& tree, const SearchRequest& request, SearchAnswer& answer);
  void (*search_range)(const RangeSearch& range, RangeCounts& counts);
  void (*sum_pairs)(const PairRange& pairs, PairSums& sums);
};

/// The loops of a level. @pre `level` is available on this machine and not kBest.
const KdTreeKernel& KernelFor(SimdLevel level);

inline KdTreeView ViewOf(const KdTreeLayout& layout) {
  return {.nodes = layout.nodes.data(),
          .limits = layout.limits.data(),
          .cells = layout.cells.data(),
          .blocks = layout.blocks.data(),
          .leaf_of_block = layout.leaf_of_block.data()};
}

}  // namespace slam6d
