// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "qwsm/search/detail/leaf_pool.hpp"
#include "qwsm/search/detail/paged_pool.hpp"
#include "qwsm/search/detail/quadtree_layout.hpp"

namespace qwsm::quadtree {

/// The tree inside PointQuadtree: numbered points in fixed-point units, at most one in a cell. It
/// knows neither metres nor scans.
class CellQuadtree {
 public:
  /// Where a point is stored. Valid until the next change of the tree.
  struct Slot {
    std::uint32_t leaf = kNoIndex;
    int index = 0;

    explicit operator bool() const { return leaf != kNoIndex; }
  };
  /// A node and the square it stands for.
  struct Subtree {
    NodeRef node;
    Square square;
  };

  /// Adds a point, or finds the one that is already in its cell and changes nothing.
  /// @return the id of the point now in the cell.
  std::uint32_t FindOrInsert(const FixedPoint& p, std::uint32_t id);
  /// The point of a cell. @pre there is one.
  FixedPoint PointIn(Cell cell) const;
  /// Moves the point of a cell within the cell. @pre there is one.
  void Move(const FixedPoint& p);
  /// Removes the point of a cell, and nodes left without points. @pre there is one.
  void Remove(Cell cell);

  bool empty() const { return !root_; }
  Subtree root() const { return {root_, root_square_}; }
  const Leaf& leaf(std::uint32_t index) const { return leaves_[index]; }
  const InnerNode& inner(std::uint32_t index) const { return inner_[index]; }

  /// Has the memory of a leaf fetched.
  void Prefetch(std::uint32_t leaf) const {
    const auto* lines = reinterpret_cast<const char*>(&leaves_[leaf]);
    for (int line = 0; line < 4; ++line) __builtin_prefetch(lines + 64 * line);
  }

  /// The leaf whose square holds the cell; kNoIndex where there is none.
  std::uint32_t LeafAt(Cell cell) const;
  /// The same, sought from a leaf nearby: up as far as it has to, and down again.
  /// @param near may be kNoIndex.
  std::uint32_t LeafAt(Cell cell, std::uint32_t near) const;
  /// The smallest node whose square holds both cells; the root where none does.
  Subtree SmallestHolding(Cell low, Cell high) const;
  /// The smallest node around the leaf that stands for `level` or more, or else the root.
  Subtree Ancestor(std::uint32_t leaf, int level) const;

  std::size_t leaf_count() const { return leaves_.size(); }
  std::size_t inner_count() const { return inner_.size(); }
  /// Nodes from the root to the deepest leaf, both counted. Cost: linear in the nodes.
  int Depth() const;
  std::size_t bytes() const { return leaves_.bytes() + inner_.bytes(); }

 private:
  std::uint32_t LeafBelow(const Subtree& part, Cell cell) const;
  void GrowTo(Cell cell);
  void EnlargeRootLeaf();
  std::uint32_t LeafFor(Cell cell);
  void Split(std::uint32_t leaf);
  std::uint32_t MoveToRoomFor(int points, std::uint32_t leaf);
  Slot Find(Cell cell) const;
  NodeRef MakeNode(const Square& square, std::uint32_t parent);
  void RemoveLeaf(std::uint32_t leaf);
  NodeRef& LinkTo(std::uint32_t parent, Cell cell, int level);
  int DepthOf(NodeRef node) const;

  NodeRef root_;
  Square root_square_;
  LeafPool leaves_;
  PagedPool<InnerNode> inner_;
};

}  // namespace qwsm::quadtree
