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
using quadtree::kBlockSize;
using quadtree::kBucketSize;
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

// Four floats side by side; every processor of the last twenty years computes with such groups.
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

Four Least(const Four& a, const Four& b) { return a < b ? a : b; }
Four Greatest(const Four& a, const Four& b) { return a > b ? a : b; }

/// The two least of numbers that are taken four at a time, first of every fourth one.
class TwoLeast {
 public:
  void Take(const Four& numbers) {
    second_ = Least(second_, Greatest(least_, numbers));
    least_ = Least(least_, numbers);
  }

  /// What all lanes know, brought together into the first one.
  void Gather() {
    Join(__builtin_shufflevector(least_, least_, 2, 3, 0, 1),
         __builtin_shufflevector(second_, second_, 2, 3, 0, 1));
    Join(__builtin_shufflevector(least_, least_, 1, 0, 3, 2),
         __builtin_shufflevector(second_, second_, 1, 0, 3, 2));
  }
  float least() const { return least_[0]; }
  float second() const { return second_[0]; }

 private:
  static constexpr float kFar = std::numeric_limits<float>::max();

  void Join(const Four& other_least, const Four& other_second) {
    second_ = Least(Least(second_, other_second), Greatest(least_, other_least));
    least_ = Least(least_, other_least);
  }

  Four least_{kFar, kFar, kFar, kFar};
  Four second_{kFar, kFar, kFar, kFar};
};

/// The nearest point of a leaf, and what no other point of it is nearer than.
///
/// Floats tell which one it is, four points at a time and without a branch that depends on where
/// they are; how far it is, and which of points that floats cannot tell apart, doubles do.
class NearestInLeaf {
 public:
  NearestInLeaf(const Leaf& leaf, const UnitPoint& center)
      : leaf_(leaf),
        x_(center.x - leaf.corner.x * kUnitsPerCell),
        y_(center.y - leaf.corner.y * kUnitsPerCell) {
    const TwoLeast coded = CodedDistances();
    const double least2 = static_cast<double>(coded.least());
    const double second2 = static_cast<double>(coded.second());
    const double error2 = ErrorOfFloats(second2);
    if (second2 - least2 > 2.0 * error2) {
      slot_ = std::bit_cast<std::int32_t>(coded.least()) & kSlotBits;
      nearest2_ = Distance2(slot_);
      second2_ = second2 - error2;
    } else {
      CompareInDoubles();
    }
  }

  double nearest2() const { return nearest2_; }
  double second2() const { return second2_; }
  int slot() const { return slot_; }

 private:
  static constexpr std::int32_t kSlotBits = 31;
  static_assert(kBucketSize <= kSlotBits);

  /// Squared distances of all points, each with its slot in the lowest bits.
  TwoLeast CodedDistances() const {
    const auto x = static_cast<float>(x_);
    const auto y = static_cast<float>(y_);
    const std::int32_t count = leaf_.count;
    const FourInts no_point = std::bit_cast<FourInts>(Four{} + std::numeric_limits<float>::max());
    TwoLeast coded;
    FourInts slots{0, 1, 2, 3};
    for (int i = 0; i < leaf_.blocks; ++i, slots += kBlockSize) {
      const Four dx = ToFloats(leaf_.block(i).x) - x;
      const Four dy = ToFloats(leaf_.block(i).y) - y;
      const auto with_slot = (std::bit_cast<FourInts>(dx * dx + dy * dy) & ~kSlotBits) | slots;
      coded.Take(std::bit_cast<Four>(slots < count ? with_slot : no_point));
    }
    coded.Gather();
    return coded;
  }

  static Four ToFloats(const std::array<std::int32_t, kBlockSize>& offsets) {
    return __builtin_convertvector(std::bit_cast<FourInts>(offsets), Four);
  }

  /// No coded distance is further off than this. Coordinates are off by 2^-24 of themselves, which
  /// the largest differences multiply, and the bits of the slot are 2^-18 of the distance.
  double ErrorOfFloats(double distance2) const {
    const double largest = static_cast<double>(leaf_.square().side()) * kUnitsPerCell +
                           std::max(std::abs(x_), std::abs(y_));
    return 0x1p-20 * largest * largest + 0x1p-18 * distance2;
  }

  // By offsets from the leaf's corner: differences of such numbers are exact.
  double Distance2(int slot) const {
    const double dx = static_cast<double>(leaf_.x(slot)) - x_;
    const double dy = static_cast<double>(leaf_.y(slot)) - y_;
    return dx * dx + dy * dy;
  }

  void CompareInDoubles() {
    for (int i = 0; i < leaf_.count; ++i) {
      const double distance2 = Distance2(i);
      second2_ = std::min(second2_, std::max(nearest2_, distance2));
      if (distance2 < nearest2_) slot_ = i;
      nearest2_ = std::min(nearest2_, distance2);
    }
  }

  const Leaf& leaf_;
  const double x_;
  const double y_;
  double nearest2_ = kInfinity;
  double second2_ = kInfinity;
  int slot_ = 0;
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
  PointId id() const { return tree_.leaf(leaf_).id(slot_); }
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
        Add({.id = leaf.id(i), .distance_m2 = distance2, .position_m = {p.x, p.y}});
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
  const std::uint32_t at = tree_.LeafAt(CellAt(query), cursor.leaf);
  SearchUpFrom(tree_, at != kNoIndex ? at : cursor.leaf, ball);
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

SearchCursor PointQuadtree::CursorAt(const Eigen::Vector2d& p_m, const SearchCursor& near) const {
  const UnitPoint p = ToUnits(p_m);
  if (!quadtree::IsFinite(p)) return {};
  const std::uint32_t known = near.revision == revision_.value() ? near.leaf : kNoIndex;
  const std::uint32_t leaf = tree_.LeafAt(CellAt(p), known);
  if (leaf != kNoIndex && leaf != known) tree_.Prefetch(leaf);
  return {.revision = revision_.value(), .leaf = leaf != kNoIndex ? leaf : known};
}

}  // namespace qwsm
