// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "qwsm/search/detail/cell_quadtree.hpp"

namespace qwsm::quadtree {

inline bool IsFinite(const UnitPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// The smallest cell of a position; the one at the edge for positions outside the largest square.
inline Cell CellAt(const UnitPoint& p) {
  const auto clamp = [](double units) {
    return static_cast<std::uint32_t>(std::clamp(units / kUnitsPerCell, 0.0, 4294967295.0));
  };
  return {clamp(p.x), clamp(p.y)};
}

/// The smallest part of the tree that a ball can reach.
inline CellQuadtree::Subtree SmallestAround(const CellQuadtree& tree,
                                            const UnitPoint& center,
                                            double radius) {
  return tree.SmallestHolding(CellAt({center.x - radius, center.y - radius}),
                              CellAt({center.x + radius, center.y + radius}));
}

inline UnitPoint PositionAt(const Leaf& leaf, int i) {
  return {leaf.corner.x * kUnitsPerCell + leaf.x(i), leaf.corner.y * kUnitsPerCell + leaf.y(i)};
}

/// Visits the leaves that a ball about a point reaches, the nearest quarter of a square first.
///
/// `Ball` has `bool Reaches(double distance2)`, asked for each node with the squared distance from
/// the ball's centre to the node's square, and `void Visit(std::uint32_t leaf)`. The ball may
/// shrink meanwhile.
template <class Ball>
class Traversal {
 public:
  Traversal(const CellQuadtree& tree, const UnitPoint& center, Ball& ball)
      : tree_(tree), center_(center), ball_(ball) {}

  void Run(const CellQuadtree::Subtree& part) {
    const double side = static_cast<double>(part.square.side()) * kUnitsPerCell;
    const UnitPoint corner{part.square.corner.x * kUnitsPerCell,
                           part.square.corner.y * kUnitsPerCell};
    const double dx = std::max({0.0, corner.x - center_.x, center_.x - (corner.x + side)});
    const double dy = std::max({0.0, corner.y - center_.y, center_.y - (corner.y + side)});
    if (part.node && ball_.Reaches(dx * dx + dy * dy)) {
      Descend(part.node, {corner.x + side / 2, corner.y + side / 2, side / 4}, dx * dx, dy * dy);
    }
  }

 private:
  /// Where a square is cut in four, and how far from there its quarters' centres are, by x and by
  /// y.
  struct Split {
    double x, y, step;
  };

  /// dx2, dy2: squared distance along each axis from the centre of the ball to the node's square.
  /// Only the two cuts are looked at on the way down (Arya and Mount 1993).
  void Descend(NodeRef node, const Split& split, double dx2, double dy2) {
    if (node.is_leaf()) return ball_.Visit(node.index());
    const double to_split_x = center_.x - split.x;
    const double to_split_y = center_.y - split.y;
    const double far_dx2 = to_split_x * to_split_x;
    const double far_dy2 = to_split_y * to_split_y;
    const unsigned nearest = (to_split_x >= 0.0 ? 1U : 0U) | (to_split_y >= 0.0 ? 2U : 0U);
    const unsigned second = far_dx2 < far_dy2 ? 1U : 2U;  // The axis whose cut is nearer.
    for (const unsigned crossed : {0U, second, 3U - second, 3U}) {
      const NodeRef child = tree_.inner(node.index()).children[nearest ^ crossed];
      if (!child) continue;
      const double child_dx2 = (crossed & 1U) != 0 ? far_dx2 : dx2;
      const double child_dy2 = (crossed & 2U) != 0 ? far_dy2 : dy2;
      if (ball_.Reaches(child_dx2 + child_dy2)) {
        Descend(child, Quarter(split, nearest ^ crossed), child_dx2, child_dy2);
      }
    }
  }

  static Split Quarter(const Split& split, unsigned quarter) {
    return {split.x + ((quarter & 1U) != 0 ? split.step : -split.step),
            split.y + ((quarter & 2U) != 0 ? split.step : -split.step),
            split.step / 2};
  }

  const CellQuadtree& tree_;
  const UnitPoint center_;
  Ball& ball_;
};

/// Squared distances of a leaf's points from a place, computed side by side.
class DistancesInLeaf {
 public:
  DistancesInLeaf(const Leaf& leaf, const UnitPoint& center) {
    // By offsets from the leaf's corner: differences of such numbers are exact.
    const double x = center.x - leaf.corner.x * kUnitsPerCell;
    const double y = center.y - leaf.corner.y * kUnitsPerCell;
    double* distance2 = distances2_.data();
    for (int i = 0; i < leaf.blocks; ++i) {
      const Block& block = leaf.block(i);
      for (std::size_t lane = 0; lane < kBlockSize; ++lane) {
        const double dx = block.x[lane] - x;
        const double dy = block.y[lane] - y;
        *distance2++ = dx * dx + dy * dy;
      }
    }
  }

  double operator[](int i) const { return distances2_[static_cast<std::size_t>(i)]; }

 private:
  std::array<double, kBucketSize> distances2_;  // As many as there are points, and a few more.
};

/// Points not farther than a radius, for Traversal.
template <class Visitor>
class Disk {
 public:
  Disk(const CellQuadtree& tree, const UnitPoint& center, double radius, const Visitor& visit)
      : tree_(tree), center_(center), radius2_(radius * radius), visit_(visit) {}

  bool Reaches(double distance2) const { return distance2 <= radius2_; }

  void Visit(std::uint32_t leaf_index) const {
    const Leaf& leaf = tree_.leaf(leaf_index);
    const DistancesInLeaf distances2(leaf, center_);
    const UnitPoint corner{leaf.corner.x * kUnitsPerCell, leaf.corner.y * kUnitsPerCell};
    const double radius2 = radius2_;
    for (int i = 0, count = leaf.count; i < count; ++i) {
      if (distances2[i] > radius2) continue;
      visit_(leaf.id(i), UnitPoint{corner.x + leaf.x(i), corner.y + leaf.y(i)});
    }
  }

 private:
  const CellQuadtree& tree_;
  const UnitPoint center_;
  const double radius2_;
  const Visitor& visit_;
};

/// The nearest point that is accepted, not farther than a radius, for Traversal.
template <class Accept>
class NearestAccepted {
 public:
  NearestAccepted(const CellQuadtree& tree,
                  const UnitPoint& center,
                  double radius,
                  const Accept& accept)
      : tree_(tree), center_(center), distance2_(radius * radius), accept_(accept) {}

  bool Reaches(double distance2) const { return distance2 <= distance2_; }

  void Visit(std::uint32_t leaf_index) {
    const Leaf& leaf = tree_.leaf(leaf_index);
    const DistancesInLeaf distances2(leaf, center_);
    for (int i = 0; i < leaf.count; ++i) {
      if (!Reaches(distances2[i]) || !accept_(leaf.id(i))) continue;
      distance2_ = distances2[i];
      leaf_ = leaf_index;
      slot_ = i;
    }
  }

  bool found() const { return leaf_ != kNoIndex; }
  double distance2() const { return distance2_; }
  std::uint32_t id() const { return tree_.leaf(leaf_).id(slot_); }
  UnitPoint position() const { return PositionAt(tree_.leaf(leaf_), slot_); }

 private:
  const CellQuadtree& tree_;
  const UnitPoint center_;
  double distance2_;  // To what was found, or as far as is looked.
  const Accept& accept_;
  std::uint32_t leaf_ = kNoIndex;
  int slot_ = 0;
};

/// How many points are not farther than a radius, for Traversal. Counts no further than wanted.
class CountingDisk {
 public:
  CountingDisk(const CellQuadtree& tree, const UnitPoint& center, double radius, int at_most)
      : tree_(tree), center_(center), radius2_(radius * radius), at_most_(at_most) {}

  bool Reaches(double distance2) const { return distance2 <= radius2_ && count_ < at_most_; }

  void Visit(std::uint32_t leaf_index) {
    const Leaf& leaf = tree_.leaf(leaf_index);
    const DistancesInLeaf distances2(leaf, center_);
    for (int i = 0; i < leaf.count; ++i) count_ += distances2[i] <= radius2_ ? 1 : 0;
  }

  int count() const { return std::min(count_, at_most_); }

 private:
  const CellQuadtree& tree_;
  const UnitPoint center_;
  const double radius2_;
  const int at_most_;
  int count_ = 0;
};

/// Calls visit(id, UnitPoint) for the points of a subtree in a box, border included.
template <class Visit>
void VisitBox(const CellQuadtree& tree,
              const CellQuadtree::Subtree& part,
              const UnitPoint& low,
              const UnitPoint& high,
              const Visit& visit) {
  const UnitPoint corner{part.square.corner.x * kUnitsPerCell,
                         part.square.corner.y * kUnitsPerCell};
  const double side = static_cast<double>(part.square.side()) * kUnitsPerCell;
  const bool overlaps = corner.x <= high.x && low.x < corner.x + side &&  //
                        corner.y <= high.y && low.y < corner.y + side;
  if (!part.node || !overlaps) return;
  if (!part.node.is_leaf()) {
    for (unsigned quarter = 0; quarter < 4; ++quarter) {
      const NodeRef child = tree.inner(part.node.index()).children[quarter];
      VisitBox(tree, {child, part.square.Quarter(quarter)}, low, high, visit);
    }
    return;
  }
  const Leaf& leaf = tree.leaf(part.node.index());
  for (int i = 0; i < leaf.count; ++i) {
    const UnitPoint p = PositionAt(leaf, i);
    const bool inside = low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
    if (inside) visit(leaf.id(i), p);
  }
}

/// Calls visit(id, UnitPoint) for all points.
template <class Visit>
void VisitAll(const CellQuadtree& tree, const Visit& visit) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  VisitBox(tree, tree.root(), {-kFar, -kFar}, {kFar, kFar}, visit);
}

}  // namespace qwsm::quadtree
