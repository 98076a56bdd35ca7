// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the searches ask of the innermost loops, which are compiled once per SimdLevel from
// sum_pairs.inc. Plain structs and pointers only: a library template instantiated in those
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
  const PointBlock* blocks;
  const std::uint32_t* leaf_of_block;
  double origin_m[3];
  const ChildPair* pairs;
  const Cell* cells;
  const FloatPoint* float_points;
};

/// One search. A subtree is left out when its squared distance is at least that of the best point
/// so far times `prune_scale`; a scale below 1 makes the search approximate.
struct SearchRequest {
  double query_m[3];
  double limit2_m2;  ///< Points farther than this are of no interest.
  double prune_scale = 1.0;
};

struct SearchAnswer {
  double distance2_m2;  ///< `limit2_m2` when nothing is nearer.
  std::uint32_t slot;   ///< kNoSlot when nothing is nearer.
  double others2_m2;    ///< No other point is nearer than this.
  std::uint32_t leaves_visited;
};

/// As Pose3, in plain numbers.
struct RigidMotion {
  double rotation[3][3];
  double translation_m[3];
};

/// Points by coordinate.
struct CloudView {
  const double* x_m;
  const double* y_m;
  const double* z_m;
};

/// So many queries, which stand next to each other, share one path.
inline constexpr std::size_t kPathBlock = kLanes;

/// Views how far the blocks of queries have moved in all.
struct PathView {
  CloudView middles;       ///< Of the blocks, in the frame of the queries.
  const double* radius_m;  ///< How far their queries are from the middle at most.
  double* path_m;
  std::size_t count;
};

/// Views what CachedSearch remembers of its queries.
struct CacheView {
  /// Per query, how near no other point was when the tree was last searched, and the path by then:
  /// the path since then is how much nearer one may be now.
  float* others_m;
  double* neighbor_x_m;
  double* neighbor_y_m;
  double* neighbor_z_m;
  std::uint32_t* slot;
  const double* path_m;  ///< Per block of queries.
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
  CloudView queries;
  RigidMotion T_tree_queries;
  CacheView cache;
  std::size_t first;
  std::size_t last;
};

/// Pairs (m_i, d_i) by coordinate, the first in the frame ref.
struct PairRange {
  CloudView ref;  ///< Infinity where there is no pair.
  CloudView cur;
  RigidMotion T_ref_cur;
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
  void (*lengthen_paths)(const PathView& paths, const RigidMotion& change, double magnitude_m);
  void (*search_range)(const RangeSearch& range, RangeCounts& counts);
  void (*sum_pairs)(const PairRange& pairs, PairSums& sums);
};

/// The loops of a level. @pre `level` is available on this machine and not kBest.
const KdTreeKernel& KernelFor(SimdLevel level);

}  // namespace slam6d
