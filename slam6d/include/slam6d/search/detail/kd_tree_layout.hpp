// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace slam6d {

/// Points are compared eight at a time: a block fills one cache line per coordinate.
inline constexpr int kLanes = 8;

/// Up to eight points of one leaf. Empty places hold infinity, which is never near to anything.
struct alignas(64) PointBlock {
  double x_m[kLanes];
  double y_m[kLanes];
  double z_m[kLanes];
};

/// A box with sides along the axes; the fourth place only fills the line.
struct alignas(64) Box {
  double low_m[4];
  double high_m[4];
};

/// A point relative to the tree's origin. Empty places hold zeros and are never read.
struct FloatPoint {
  float x_m;
  float y_m;
  float z_m;
};

/// Both children of an inner node as searches of several queries read them: one cache line. Boxes
/// are those of the points really in them, by x, y, z relative to the tree's origin.
struct alignas(64) ChildPair {
  float low_m[2][3];
  float high_m[2][3];
  std::uint32_t first[2];        ///< The pair of a child's own children, or its first block.
  std::uint32_t point_count[2];  ///< Points of a leaf; 0 for an inner node.
};

/// The part of space that the cuts leave a node, relative to the tree's origin, and the way up from
/// it and down: half a cache line.
struct alignas(32) Cell {
  float low_m[3];
  float high_m[3];
  std::uint32_t parent;  ///< The root is its own parent.
  std::uint32_t pair;    ///< Of the node's children; kNoPair for a leaf.
};

/// A node of the tree: two children side by side, or a leaf with its blocks of points.
struct KdNode {
  static constexpr std::uint32_t kLeaf = 3;

  double split_m = 0.0;           ///< The cut across `axis`; points on it belong to the left child.
  std::uint32_t axis = kLeaf;     ///< 0, 1, 2 = x, y, z.
  std::uint32_t first = 0;        ///< The left child, or the leaf's first block.
  std::uint32_t point_count = 0;  ///< Points of a leaf; they fill its blocks in order.
};

/// A kd-tree as the searches read it: with the limits of its points and a pointer to the
/// predecessor in each node, as a cached search needs them (Nüchter et al. 2007, section 4.1). Node
/// 0 is the root; slot s is place s % 8 of block s / 8.
struct KdTreeLayout {
  static constexpr std::uint32_t kNoSlot = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t kNoPair = std::numeric_limits<std::uint32_t>::max();
  /// Most nodes on a path from the root; the searches' stacks rely on it.
  static constexpr int kMaxDepth = 96;

  std::vector<KdNode> nodes;
  std::vector<Box> limits;  ///< Per node, the box of the points really in it.
  std::vector<PointBlock> blocks;
  std::vector<std::uint32_t> index_of_slot;  ///< Per slot, its point's place in the cloud.
  std::vector<std::uint32_t> leaf_of_block;
  /// Places in the cloud of all finite points, equal ones too, leaf by leaf: points near each other
  /// stand near each other.
  std::vector<std::uint32_t> order;

  /// What searches in floats read. The origin is the middle of most points.
  double origin_m[3] = {};
  std::vector<Cell> cells;               ///< Per node; the root's is all of space.
  std::vector<ChildPair> pairs;          ///< Per inner node, at PairOf its left child.
  std::vector<FloatPoint> float_points;  ///< Per slot.

  /// Children are numbered two by two behind the root.
  static constexpr std::uint32_t PairOf(std::uint32_t left_child) { return (left_child - 1) / 2; }
};

}  // namespace slam6d
