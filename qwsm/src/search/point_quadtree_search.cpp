// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "qwsm/search/point_quadtree.hpp"

namespace qwsm {

using quadtree::Cell;
using quadtree::CellAt;
using quadtree::CellQuadtree;
using quadtree::kNoIndex;
using quadtree::kUnitsPerCell;
using quadtree::Leaf;
using quadtree::Square;
using quadtree::Traversal;
using quadtree::UnitPoint;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// So that what is exactly as far counts, too.
double JustAbove(double distance2) {
  return distance2 * (1.0 + std::numeric_limits<double>::epsilon()) +
         std::numeric_limits<double>::min();
}

double Distance2(const UnitPoint& a, const UnitPoint& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return dx * dx + dy * dy;
}

// Two doubles side by side; every processor of the last twenty years computes with such pairs.
using Two = double __attribute__((vector_size(16)));
using TwoIndices = std::int64_t __attribute__((vector_size(16)));

/// The nearest and the second nearest of the points in every other slot, and of those between.
struct NearestOfSlots {
  Two nearest2{kInfinity, kInfinity};
  Two second2{kInfinity, kInfinity};
  TwoIndices slot{};

  /// Of two slots, the first one has an even number.
  void Take(const Two& distance2, const TwoIndices& at) {
    const Two farther = nearest2 < distance2 ? distance2 : nearest2;
    second2 = farther < second2 ? farther : second2;
    slot = distance2 < nearest2 ? at : slot;
    nearest2 = distance2 < nearest2 ? distance2 : nearest2;
  }
  void Take(const NearestOfSlots& other) {
    Take(other.nearest2, other.slot);
    second2 = other.second2 < second2 ? other.second2 : second2;
  }
};

/// The nearest and the second nearest point of a leaf, without a branch that depends on where they
/// are: there is nothing to predict. Four points at a time, in two chains that do not wait for each
/// other.
class NearestInLeaf {
 public:
  NearestInLeaf(const Leaf& leaf, const UnitPoint& center)
      : leaf_(leaf),
        x_(center.x - leaf.corner.x * kUnitsPerCell),
        y_(center.y - leaf.corner.y * kUnitsPerCell) {
    NearestOfSlots others;
    std::size_t i = 0;
    for (; i + 4 <= leaf.count; i += 4) {
      slots_.Take(Distance2(i, i + 1), Slots(i));
      others.Take(Distance2(i + 2, i + 3), Slots(i + 2));
    }
    if (i + 2 <= leaf.count) {
      slots_.Take(Distance2(i, i + 1), Slots(i));
      i += 2;
    }
    if (i < leaf.count) others.Take(Two{Distance2(i, i)[0], kInfinity}, Slots(i));
    slots_.Take(others);
  }

  double nearest2() const { return std::min(slots_.nearest2[0], slots_.nearest2[1]); }
  double second2() const {
    return std::min({std::max(slots_.nearest2[0], slots_.nearest2[1]),  //
                     slots_.second2[0],
                     slots_.second2[1]});
  }
  int slot() const {
    return static_cast<int>(slots_.slot[slots_.nearest2[1] < slots_.nearest2[0] ? 1 : 0]);
  }

 private:
  static TwoIndices Slots(std::size_t first) {
    const auto slot = static_cast<std::int64_t>(first);
    return TwoIndices{slot, slot + 1};
  }
  // By offsets from the leaf's corner: differences of such numbers are exact.
  Two Distance2(std::size_t i, std::size_t j) const {
    const Two dx = Two{static_cast<double>(leaf_.x[i]), static_cast<double>(leaf_.x[j])} - x_;
    const Two dy = Two{static_cast<double>(leaf_.y[i]), static_cast<double>(leaf_.y[j])} - y_;
    return dx * dx + dy * dy;
  }

  const Leaf& leaf_;
  const double x_;
  const double y_;
  NearestOfSlots slots_;
};

/// The ball about the query that shrinks to the nearest point, and what is known about all others.
class NearestBall {
 public:
  NearestBall(const CellQuadtree& tree, const UnitPoint& center, double radius)
      : tree_(tree), center_(center), radius2_(JustAbove(radius * radius)) {}

  bool Reaches(double distance2) {
    if (distance2 < radius2_) return true;
    NoteOtherLeafAt(distance2);
    return false;
  }

  void Visit(std::uint32_t leaf_index) {
    if (leaf_index == first_leaf_) return;
    if (first_leaf_ == kNoIndex) first_leaf_ = leaf_index;
    const NearestInLeaf in_leaf(tree_.leaf(leaf_index), center_);
    const double nearest2 = in_leaf.nearest2();
    if (nearest2 >= radius2_) return NoteOtherLeafAt(nearest2);
    if (found()) NoteOtherLeafAt(radius2_);
    radius2_ = nearest2;
    second2_ = in_leaf.second2();
    leaf_ = leaf_index;
    slot_ = in_leaf.slot();
  }

  /// No point of a leaf other than that of the nearest point is nearer.
  void NoteOtherLeafAt(double distance2) { other_leaf2_ = std::min(other_leaf2_, distance2); }

  bool found() const { return leaf_ != kNoIndex; }
  double radius2() const { return radius2_; }
  const UnitPoint& center() const { return center_; }
  std::uint32_t leaf() const { return leaf_; }
  PointId id() const { return tree_.leaf(leaf_).id[static_cast<std::size_t>(slot_)]; }
  UnitPoint position() const { return quadtree::PositionAt(tree_.leaf(leaf_), slot_); }
  double clearance_of_point() const { return std::sqrt(std::min(other_leaf2_, second2_)); }

 private:
  const CellQuadtree& tree_;
  const UnitPoint center_;
  double radius2_;  ///< Only points nearer than this count.
  double second2_ = kInfinity;
  double other_leaf2_ = kInfinity;
  std::uint32_t first_leaf_ = kNoIndex;
  std::uint32_t leaf_ = kNoIndex;
  int slot_ = 0;
};

/// The ball about the query that shrinks to the k-th nearest point. The points found are kept as a
/// heap, the farthest in front, in units rather than metres.
class KNearestBall {
 public:
  KNearestBall(const CellQuadtree& tree,
               const UnitPoint& center,
               double radius,
               std::size_t k,
               std::vector<Neighbor>& heap)
      : tree_(tree), center_(center), radius2_(JustAbove(radius * radius)), k_(k), heap_(heap) {}

  bool Reaches(double distance2) const { return distance2 < radius2_; }

  void Visit(std::uint32_t leaf_index) {
    const Leaf& leaf = tree_.leaf(leaf_index);
    for (int i = 0; i < leaf.count; ++i) {
      const UnitPoint p = quadtree::PositionAt(leaf, i);
      const double distance2 = Distance2(p, center_);
      if (distance2 < radius2_) {
        Add({.id = leaf.id[static_cast<std::size_t>(i)],
             .distance_m2 = distance2,
             .position_m = {p.x, p.y}});
      }
    }
  }

 private:
  void Add(const Neighbor& neighbor) {
    if (heap_.size() == k_) {
      std::ranges::pop_heap(heap_, {}, &Neighbor::distance_m2);
      heap_.pop_back();
    }
    heap_.push_back(neighbor);
    std::ranges::push_heap(heap_, {}, &Neighbor::distance_m2);
    if (heap_.size() == k_) radius2_ = heap_.front().distance_m2;
  }

  const CellQuadtree& tree_;
  const UnitPoint center_;
  double radius2_;
  const std::size_t k_;
  std::vector<Neighbor>& heap_;
};

/// The smallest node around a leaf and a ball, or else the root: the ball-within-bounds test of
/// Nuechter et al. (2007, section 4.1), for all levels at once. Squares are aligned to their size,
/// so the bits in which the corners of the ball's box differ tell the level.
CellQuadtree::Subtree SmallestAround(const CellQuadtree& tree,
                                     std::uint32_t leaf,
                                     const NearestBall& ball) {
  const double radius = std::sqrt(ball.radius2());
  const Cell low = CellAt({ball.center().x - radius, ball.center().y - radius});
  const Cell high = CellAt({ball.center().x + radius, ball.center().y + radius});
  const Cell inside = tree.leaf(leaf).corner;
  const std::uint32_t differing =
      (low.x ^ inside.x) | (high.x ^ inside.x) | (low.y ^ inside.y) | (high.y ^ inside.y);
  return tree.Ancestor(leaf, std::bit_width(differing));
}

double DistanceToBorder(const Square& square, const UnitPoint& p) {
  const double side = static_cast<double>(square.side()) * kUnitsPerCell;
  const double x = p.x - square.corner.x * kUnitsPerCell;
  const double y = p.y - square.corner.y * kUnitsPerCell;
  return std::max(0.0, std::min({x, side - x, y, side - y}));
}

/// Bottom-up search: `leaf` makes the ball small, then the smallest node around it is searched.
void SearchUpFrom(const CellQuadtree& tree, std::uint32_t leaf, NearestBall& ball) {
  CellQuadtree::Subtree around;
  if (leaf != kNoIndex) {
    ball.Visit(leaf);
    const double to_border = DistanceToBorder(tree.leaf(leaf).square(), ball.center());
    if (to_border * to_border >= ball.radius2()) return ball.NoteOtherLeafAt(to_border * to_border);
    around = SmallestAround(tree, leaf, ball);
  } else {
    around = quadtree::SmallestAround(tree, ball.center(), std::sqrt(ball.radius2()));
  }
  if (around.square.level < tree.root().square.level) {
    const double border = DistanceToBorder(around.square, ball.center());
    ball.NoteOtherLeafAt(border * border);
  }
  Traversal(tree, ball.center(), ball).Run(around);
}

/// Triangle inequality: all other points were at least `clearance` away from where the query was,
/// so they are at least `clearance - moved` away now. Whether a point at `distance2` is nearer.
bool IsNearerThanOthers(double distance2, double moved2, double clearance) {
  // sqrt(distance2) + sqrt(moved2) <= clearance, without the roots and safe against rounding.
  const double slack = clearance * clearance * (1.0 - 1e-12) - distance2 - moved2;
  return slack >= 0.0 && slack * slack >= 4.0 * distance2 * moved2;
}

}  // namespace

std::optional<Neighbor> PointQuadtree::Nearest(const Eigen::Vector2d& query_m,
                                               double max_distance_m) const {
  const UnitPoint query = ToUnits(query_m);
  if (!(max_distance_m >= 0.0) || !quadtree::IsFinite(query)) return std::nullopt;
  NearestBall ball(tree_, query, ToUnits(max_distance_m));
  SearchUpFrom(tree_, tree_.LeafAt(CellAt(query)), ball);
  if (!ball.found()) return std::nullopt;
  return ToNeighbor(ball.id(), ball.radius2(), ball.position());
}

std::optional<Neighbor> PointQuadtree::Nearest(const Eigen::Vector2d& query_m,
                                               double max_distance_m,
                                               SearchCursor& cursor) const {
  const UnitPoint query = ToUnits(query_m);
  if (!(max_distance_m >= 0.0) || !quadtree::IsFinite(query)) return std::nullopt;
  const double max_distance = ToUnits(max_distance_m);
  if (cursor.revision != revision_.value()) cursor = SearchCursor();

  if (cursor.leaf != kNoIndex) {
    const double distance2 = Distance2(cursor.neighbor, query);
    const double moved2 = Distance2(cursor.query, query);
    if (IsNearerThanOthers(distance2, moved2, cursor.clearance_of_point)) {
      if (distance2 > max_distance * max_distance) return std::nullopt;
      return ToNeighbor(cursor.id, distance2, cursor.neighbor);
    }
  }
  NearestBall ball(tree_, query, max_distance);
  std::uint32_t start = cursor.leaf;
  if (start == kNoIndex || !tree_.leaf(start).square().Contains(CellAt(query))) {
    const std::uint32_t at = tree_.LeafAt(CellAt(query));
    if (at != kNoIndex) start = at;
  }
  SearchUpFrom(tree_, start, ball);
  cursor.revision = revision_.value();
  cursor.leaf = ball.leaf();
  cursor.query = query;
  cursor.clearance_of_point = ball.clearance_of_point();
  if (!ball.found()) return std::nullopt;
  cursor.id = ball.id();
  cursor.neighbor = ball.position();
  return ToNeighbor(cursor.id, ball.radius2(), cursor.neighbor);
}

void PointQuadtree::KNearest(const Eigen::Vector2d& query_m,
                             std::size_t k,
                             double max_distance_m,
                             std::vector<Neighbor>& out) const {
  out.clear();
  const UnitPoint query = ToUnits(query_m);
  if (k == 0 || !(max_distance_m >= 0.0) || !quadtree::IsFinite(query)) return;
  KNearestBall ball(tree_, query, ToUnits(max_distance_m), k, out);
  Traversal(tree_, query, ball).Run(tree_.root());
  std::ranges::sort_heap(out, {}, &Neighbor::distance_m2);
  for (Neighbor& neighbor : out) {
    neighbor = ToNeighbor(
        neighbor.id, neighbor.distance_m2, {neighbor.position_m.x(), neighbor.position_m.y()});
  }
}

int PointQuadtree::CountInRadius(const Eigen::Vector2d& center_m,
                                 double radius_m,
                                 int at_most) const {
  const UnitPoint center = ToUnits(center_m);
  const double radius = ToUnits(radius_m);
  if (!(radius >= 0.0) || !quadtree::IsFinite(center)) return 0;
  quadtree::CountingDisk disk(tree_, center, radius, at_most);
  Traversal(tree_, center, disk).Run(quadtree::SmallestAround(tree_, center, radius));
  return disk.count();
}

SearchCursor PointQuadtree::CursorAt(const Eigen::Vector2d& p_m) const {
  const UnitPoint p = ToUnits(p_m);
  if (!quadtree::IsFinite(p)) return {};
  const std::uint32_t leaf = tree_.LeafAt(CellAt(p));
  if (leaf != kNoIndex) tree_.Prefetch(leaf);
  return {.revision = revision_.value(), .leaf = leaf};
}

}  // namespace qwsm
