// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/detail/cell_quadtree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace qwsm::quadtree {
namespace {

constexpr std::int32_t Offset(std::uint32_t cell, std::uint16_t fraction, std::uint32_t corner) {
  return static_cast<std::int32_t>(((cell - corner) << kFractionBits) + fraction);
}

Cell CellOf(const Leaf& leaf, int i) {
  return {leaf.corner.x + (static_cast<std::uint32_t>(leaf.x(i)) >> kFractionBits),
          leaf.corner.y + (static_cast<std::uint32_t>(leaf.y(i)) >> kFractionBits)};
}

int IndexOf(const Leaf& leaf, Cell cell) {
  const auto x = static_cast<std::int32_t>(cell.x - leaf.corner.x);
  const auto y = static_cast<std::int32_t>(cell.y - leaf.corner.y);
  const auto is_at = [&](int i) {
    return leaf.x(i) >> kFractionBits == x && leaf.y(i) >> kFractionBits == y;
  };
  int i = 0;
  while (i < leaf.count && !is_at(i)) ++i;
  return i;
}

void Put(Leaf& leaf, int i, const FixedPoint& p) {
  leaf.x(i) = Offset(p.cell.x, p.fraction_x, leaf.corner.x);
  leaf.y(i) = Offset(p.cell.y, p.fraction_y, leaf.corner.y);
}

void Append(Leaf& leaf, const FixedPoint& p, std::uint32_t id) {
  assert(leaf.count < leaf.room() && leaf.square().Contains(p.cell));
  Put(leaf, leaf.count, p);
  leaf.id(leaf.count) = id;
  ++leaf.count;
}

FixedPoint PointAt(const Leaf& leaf, int i) {
  constexpr std::int32_t kFractionMask = (1 << kFractionBits) - 1;
  return {CellOf(leaf, i),
          static_cast<std::uint16_t>(leaf.x(i) & kFractionMask),
          static_cast<std::uint16_t>(leaf.y(i) & kFractionMask)};
}

/// How many points of a leaf are in each quarter of its square.
std::array<int, 4> CountByQuarter(const Leaf& leaf) {
  std::array<int, 4> counts{};
  for (int i = 0; i < leaf.count; ++i) ++counts[leaf.square().QuarterOf(CellOf(leaf, i))];
  return counts;
}

}  // namespace

std::uint32_t CellQuadtree::FindOrInsert(const FixedPoint& p, std::uint32_t id) {
  GrowTo(p.cell);
  std::uint32_t target = LeafFor(p.cell);
  const Leaf& found = leaves_[target];
  if (const int i = IndexOf(found, p.cell); i < found.count) return found.id(i);
  // Ends because a cell holds one point: more than kBucketSize are not in one smallest cell.
  while (leaves_[target].count == kBucketSize) {
    Split(target);
    target = LeafFor(p.cell);
  }
  if (leaves_[target].count == leaves_[target].room()) {
    target = MoveToRoomFor(leaves_[target].count + 1, target);
  }
  Append(leaves_[target], p, id);
  return id;
}

FixedPoint CellQuadtree::PointIn(Cell cell) const {
  const Slot slot = Find(cell);
  return PointAt(leaves_[slot.leaf], slot.index);
}

void CellQuadtree::Move(const FixedPoint& p) {
  const Slot slot = Find(p.cell);
  Put(leaves_[slot.leaf], slot.index, p);
}

void CellQuadtree::Remove(Cell cell) {
  const Slot slot = Find(cell);
  Leaf& leaf = leaves_[slot.leaf];
  const int last = --leaf.count;
  leaf.x(slot.index) = leaf.x(last);
  leaf.y(slot.index) = leaf.y(last);
  leaf.id(slot.index) = leaf.id(last);
  if (leaf.count == 0) {
    RemoveLeaf(slot.leaf);
  } else if (leaf.count <= leaf.room() - kBlockSize) {
    MoveToRoomFor(leaf.count, slot.leaf);
  }
}

/// Puts a leaf with the same points, and room for so many, in the place of a leaf; returns it.
std::uint32_t CellQuadtree::MoveToRoomFor(int points, std::uint32_t leaf) {
  const Leaf& old = leaves_[leaf];
  const std::uint32_t moved = leaves_.Add(old.square(), old.parent, points);
  Leaf& copy = leaves_[moved];
  std::copy_n(&old.block(0), std::min(old.blocks, copy.blocks), &copy.block(0));
  copy.count = old.count;
  LinkTo(old.parent, old.corner, old.level) = NodeRef::Leaf(moved);
  leaves_.Free(leaf);
  return moved;
}

std::uint32_t CellQuadtree::LeafAt(Cell cell) const {
  if (!root_ || !root_square_.Contains(cell)) return kNoIndex;
  return LeafBelow(root(), cell);
}

std::uint32_t CellQuadtree::LeafAt(Cell cell, std::uint32_t near) const {
  if (near == kNoIndex) return LeafAt(cell);
  const Square square = leaves_[near].square();
  if (square.Contains(cell)) return near;
  const std::uint32_t differing = (cell.x ^ square.corner.x) | (cell.y ^ square.corner.y);
  const Subtree around = Ancestor(near, std::bit_width(differing));
  return around.square.Contains(cell) ? LeafBelow(around, cell) : kNoIndex;
}

// @pre the cell is in the square of that part.
std::uint32_t CellQuadtree::LeafBelow(const Subtree& part, Cell cell) const {
  NodeRef node = part.node;
  for (Square at = {cell, part.square.level}; node.is_inner(); --at.level) {
    node = inner_[node.index()].children[at.QuarterOf(cell)];
  }
  return node ? node.index() : kNoIndex;
}

CellQuadtree::Subtree CellQuadtree::SmallestHolding(Cell low, Cell high) const {
  if (!root_ || !root_square_.Contains(low) || !root_square_.Contains(high)) return root();
  // Squares are aligned to their size, so the bits in which the cells differ tell the level.
  const int smallest = std::bit_width((low.x ^ high.x) | (low.y ^ high.y));
  NodeRef node = root_;
  Square square{low, root_square_.level};
  for (; node.is_inner() && square.level > smallest; --square.level) {
    node = inner_[node.index()].children[square.QuarterOf(low)];
  }
  return {node, square.AtLevel(square.level)};
}

CellQuadtree::Subtree CellQuadtree::Ancestor(std::uint32_t leaf, int level) const {
  const Leaf& start = leaves_[leaf];
  if (level >= root_square_.level) return root();
  if (level <= start.level) return {NodeRef::Leaf(leaf), start.square()};
  std::uint32_t node = start.parent;
  for (int at = start.level + 1; at < level; ++at) node = inner_[node].parent;
  return {NodeRef::Inner(node), start.square().AtLevel(level)};
}

int CellQuadtree::Depth() const { return DepthOf(root_); }

int CellQuadtree::DepthOf(NodeRef node) const {
  if (!node) return 0;
  int below = 0;
  if (!node.is_leaf()) {
    for (const NodeRef child : inner_[node.index()].children) {
      below = std::max(below, DepthOf(child));
    }
  }
  return 1 + below;
}

CellQuadtree::Slot CellQuadtree::Find(Cell cell) const {
  const std::uint32_t leaf = LeafAt(cell);
  assert(leaf != kNoIndex);
  const int i = IndexOf(leaves_[leaf], cell);
  assert(i < leaves_[leaf].count);
  return {leaf, i};
}

/// Doubles the root until it contains the cell. The first root is the first cell.
void CellQuadtree::GrowTo(Cell cell) {
  if (!root_) {
    root_square_ = {cell, 0};
    root_ = MakeNode(root_square_, kNoIndex);
  }
  while (!root_square_.Contains(cell)) {
    if (root_.is_leaf() && root_square_.level < kMaxLeafLevel) {
      EnlargeRootLeaf();
      continue;
    }
    const Square old_square = root_square_;
    const NodeRef old_root = root_;
    root_square_ = old_square.AtLevel(old_square.level + 1);
    root_ = NodeRef::Inner(inner_.Add({}));
    inner_[root_.index()].children[root_square_.QuarterOf(old_square.corner)] = old_root;
    if (old_root.is_leaf()) {
      leaves_[old_root.index()].parent = root_.index();
    } else {
      inner_[old_root.index()].parent = root_.index();
    }
  }
}

/// A root that is a leaf needs no inner nodes above it to grow.
void CellQuadtree::EnlargeRootLeaf() {
  root_square_ = root_square_.AtLevel(root_square_.level + 1);
  Leaf& leaf = leaves_[root_.index()];
  const Leaf old = leaf;
  leaf.corner = root_square_.corner;
  leaf.level = static_cast<std::uint8_t>(root_square_.level);
  for (int i = 0; i < leaf.count; ++i) {
    leaf.x(i) += Offset(old.corner.x, 0, leaf.corner.x);
    leaf.y(i) += Offset(old.corner.y, 0, leaf.corner.y);
  }
}

NodeRef CellQuadtree::MakeNode(const Square& square, std::uint32_t parent) {
  if (square.level > kMaxLeafLevel)
    return NodeRef::Inner(inner_.Add({.children = {}, .parent = parent}));
  return NodeRef::Leaf(leaves_.Add(square, parent, 1));
}

/// The leaf whose square holds the cell, made if there is none. @pre the root contains the cell
std::uint32_t CellQuadtree::LeafFor(Cell cell) {
  NodeRef node = root_;
  for (Square at = {cell, root_square_.level}; node.is_inner(); --at.level) {
    const std::uint32_t parent = node.index();
    const unsigned quarter = at.QuarterOf(cell);
    node = inner_[parent].children[quarter];
    if (!node) {
      node = MakeNode(at.AtLevel(at.level - 1), parent);
      inner_[parent].children[quarter] = node;
    }
  }
  return node.index();
}

/// Puts an inner node with up to four leaves in the place of a leaf.
void CellQuadtree::Split(std::uint32_t leaf) {
  const Leaf& old = leaves_[leaf];
  assert(old.level > 0);
  const std::uint32_t node = inner_.Add({.children = {}, .parent = old.parent});
  LinkTo(old.parent, old.corner, old.level) = NodeRef::Inner(node);
  const std::array<int, 4> counts = CountByQuarter(old);
  for (int i = 0; i < old.count; ++i) {
    const FixedPoint p = PointAt(old, i);
    const unsigned quarter = old.square().QuarterOf(p.cell);
    NodeRef& child = inner_[node].children[quarter];
    if (!child) {
      child = NodeRef::Leaf(leaves_.Add(old.square().Quarter(quarter), node, counts[quarter]));
    }
    Append(leaves_[child.index()], p, old.id(i));
  }
  leaves_.Free(leaf);
}

void CellQuadtree::RemoveLeaf(std::uint32_t leaf) {
  const Cell corner = leaves_[leaf].corner;
  int level = leaves_[leaf].level;
  std::uint32_t parent = leaves_[leaf].parent;
  leaves_.Free(leaf);
  LinkTo(parent, corner, level) = NodeRef();
  const auto has_child = [](NodeRef child) { return static_cast<bool>(child); };
  while (parent != kNoIndex && std::ranges::none_of(inner_[parent].children, has_child)) {
    ++level;
    const std::uint32_t childless = parent;
    parent = inner_[childless].parent;
    inner_.Free(childless);
    LinkTo(parent, corner, level) = NodeRef();
  }
}

/// What refers to the node of `level` that holds `cell`: its parent's link, or the root.
NodeRef& CellQuadtree::LinkTo(std::uint32_t parent, Cell cell, int level) {
  if (parent == kNoIndex) return root_;
  return inner_[parent].children[Square{cell, level + 1}.QuarterOf(cell)];
}

}  // namespace qwsm::quadtree
