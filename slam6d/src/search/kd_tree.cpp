// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/search/kd_tree.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "slam6d/cloud/bounds.hpp"
#include "slam6d/src/search/kernel_views.hpp"

namespace slam6d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Cutting at the middle can need one level per power of two of the coordinates; from this depth on
/// the points are halved instead, which ends after at most 32 more levels.
constexpr int kMiddleCutDepth = KdTreeLayout::kMaxDepth - 34;

/// The origin is the middle of the points but for this share at either end of an axis, by about so
/// many of the points. Were it that of all, a stray one at 1000 km would have floats tell points
/// apart by 6 cm only, and nearly every query searched once more in doubles.
constexpr double kOriginStrayShare = 0.1;
constexpr std::size_t kOriginSample = 5000;

struct IndexedPoint {
  std::array<double, 3> at_m;
  std::uint32_t index;
};

struct Subtree {
  std::span<IndexedPoint> points;
  std::uint32_t node;
  int depth;
};

Cell Everywhere() {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  return {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}, 0, KdTreeLayout::kNoPair};
}

Box LimitsOf(std::span<const IndexedPoint> points) {
  Box box{{kInfinity, kInfinity, kInfinity, 0.0}, {-kInfinity, -kInfinity, -kInfinity, 0.0}};
  for (const IndexedPoint& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low_m[axis] = std::min(box.low_m[axis], point.at_m[axis]);
      box.high_m[axis] = std::max(box.high_m[axis], point.at_m[axis]);
    }
  }
  return box;
}

double MiddleOfMost(std::span<const IndexedPoint> points, std::size_t axis) {
  std::vector<double> along_m;
  const std::size_t step = points.size() / kOriginSample + 1;
  for (std::size_t i = 0; i < points.size(); i += step) along_m.push_back(points[i].at_m[axis]);
  const Bounds most_m = BoundsOf(std::move(along_m), kOriginStrayShare);
  return 0.5 * most_m.low + 0.5 * most_m.high;
}

std::size_t LongestAxis(const Box& box) {
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (box.high_m[axis] - box.low_m[axis] > box.high_m[longest] - box.low_m[longest]) {
      longest = axis;
    }
  }
  return longest;
}

/// A cut that leaves points on both sides: low <= cut < high.
double MiddleCut(double low_m, double high_m) {
  const double middle_m = 0.5 * low_m + 0.5 * high_m;
  return middle_m < high_m ? std::max(middle_m, low_m) : low_m;
}

double MedianCut(std::span<IndexedPoint> points, std::size_t axis, double high_m) {
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  const auto before = [axis](const IndexedPoint& a, const IndexedPoint& b) {
    return a.at_m[axis] < b.at_m[axis];
  };
  std::nth_element(points.begin(), middle, points.end(), before);
  if (middle->at_m[axis] < high_m) return middle->at_m[axis];
  // The upper half is all one value: cut below it.
  double below_m = -kInfinity;
  for (const IndexedPoint& point : points) {
    if (point.at_m[axis] < high_m) below_m = std::max(below_m, point.at_m[axis]);
  }
  return below_m;
}

/// Builds the layout from the root down; the subtrees not yet built wait on a stack.
class Builder {
 public:
  Builder(KdTreeLayout& layout, std::size_t bucket_size)
      : layout_(layout), bucket_size_(bucket_size) {}

  /// Returns the number of different points.
  std::size_t Build(std::span<IndexedPoint> points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      layout_.origin_m[axis] = MiddleOfMost(points, axis);
    }
    AddNode(0, Everywhere());
    std::vector<Subtree> open{{points, 0, 0}};
    while (!open.empty()) {
      const Subtree subtree = open.back();
      open.pop_back();
      const Box limits = LimitsOf(subtree.points);
      layout_.limits[subtree.node] = limits;
      const std::size_t axis = LongestAxis(limits);
      const bool all_equal = !(limits.high_m[axis] > limits.low_m[axis]);
      const bool is_leaf = all_equal || subtree.points.size() <= bucket_size_;
      if (is_leaf) AppendOrder(subtree.points);
      if (all_equal) {
        MakeLeaf(subtree.node, FirstOf(subtree.points));
      } else if (is_leaf) {
        MakeLeaf(subtree.node, subtree.points);
      } else {
        Cut(subtree, axis, open);
      }
    }
    FillPairs();
    return size_;
  }

 private:
  float ToFloat(double coordinate_m, std::size_t axis) const {
    return static_cast<float>(coordinate_m - layout_.origin_m[axis]);
  }

  FloatPoint ToFloats(const IndexedPoint& point) const {
    return {ToFloat(point.at_m[0], 0), ToFloat(point.at_m[1], 1), ToFloat(point.at_m[2], 2)};
  }

  void FillPairs() {
    layout_.pairs.resize(layout_.nodes.size() / 2);
    for (std::uint32_t child = 1; child < layout_.nodes.size(); ++child) {
      const KdNode& node = layout_.nodes[child];
      const bool is_leaf = node.axis == KdNode::kLeaf;
      ChildPair& pair = layout_.pairs[KdTreeLayout::PairOf(child)];
      const std::size_t side = (child - 1) % 2;
      pair.first[side] = is_leaf ? node.first : KdTreeLayout::PairOf(node.first);
      pair.point_count[side] = node.point_count;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        pair.low_m[side][axis] = ToFloat(layout_.limits[child].low_m[axis], axis);
        pair.high_m[side][axis] = ToFloat(layout_.limits[child].high_m[axis], axis);
      }
    }
  }

  void AddNode(std::uint32_t parent, const Cell& cell) {
    layout_.nodes.emplace_back();
    layout_.limits.emplace_back();
    layout_.cells.push_back(cell);
    layout_.cells.back().parent = parent;
  }

  void AppendOrder(std::span<const IndexedPoint> points) {
    for (const IndexedPoint& point : points) layout_.order.push_back(point.index);
  }

  /// Of equal points the one that stands first in the cloud.
  static std::span<IndexedPoint> FirstOf(std::span<IndexedPoint> points) {
    const auto earlier = [](const IndexedPoint& a, const IndexedPoint& b) {
      return a.index < b.index;
    };
    std::iter_swap(points.begin(), std::min_element(points.begin(), points.end(), earlier));
    return points.first(1);
  }

  void Cut(const Subtree& subtree, std::size_t axis, std::vector<Subtree>& open) {
    const Box limits = layout_.limits[subtree.node];
    const double cut_m = subtree.depth < kMiddleCutDepth
                             ? MiddleCut(limits.low_m[axis], limits.high_m[axis])
                             : MedianCut(subtree.points, axis, limits.high_m[axis]);
    const auto in_left = [axis, cut_m](const IndexedPoint& p) { return p.at_m[axis] <= cut_m; };
    const auto border = std::partition(subtree.points.begin(), subtree.points.end(), in_left);
    const auto left_size = static_cast<std::size_t>(border - subtree.points.begin());

    const auto left = static_cast<std::uint32_t>(layout_.nodes.size());
    KdNode& node = layout_.nodes[subtree.node];
    node.split_m = cut_m;
    node.axis = static_cast<std::uint32_t>(axis);
    node.first = left;
    Cell left_cell = layout_.cells[subtree.node];
    Cell right_cell = left_cell;
    layout_.cells[subtree.node].pair = KdTreeLayout::PairOf(left);
    left_cell.high_m[axis] = ToFloat(cut_m, axis);
    right_cell.low_m[axis] = ToFloat(cut_m, axis);
    AddNode(subtree.node, left_cell);
    AddNode(subtree.node, right_cell);
    open.push_back({subtree.points.subspan(left_size), left + 1, subtree.depth + 1});
    open.push_back({subtree.points.first(left_size), left, subtree.depth + 1});
  }

  void MakeLeaf(std::uint32_t node, std::span<const IndexedPoint> points) {
    const std::size_t block_count = (points.size() + kLanes - 1) / kLanes;
    layout_.nodes[node].first = static_cast<std::uint32_t>(layout_.blocks.size());
    layout_.nodes[node].point_count = static_cast<std::uint32_t>(points.size());
    for (std::size_t slot = 0; slot < block_count * kLanes; ++slot) {
      if (slot % kLanes == 0) {
        layout_.blocks.emplace_back();
        layout_.leaf_of_block.push_back(node);
      }
      const bool filled = slot < points.size();
      PointBlock& block = layout_.blocks.back();
      block.x_m[slot % kLanes] = filled ? points[slot].at_m[0] : kInfinity;
      block.y_m[slot % kLanes] = filled ? points[slot].at_m[1] : kInfinity;
      block.z_m[slot % kLanes] = filled ? points[slot].at_m[2] : kInfinity;
      layout_.float_points.push_back(filled ? ToFloats(points[slot]) : FloatPoint{});
      layout_.index_of_slot.push_back(filled ? points[slot].index : KdTreeLayout::kNoSlot);
    }
    size_ += points.size();
  }

  KdTreeLayout& layout_;
  std::size_t bucket_size_;
  std::size_t size_ = 0;
};

std::vector<IndexedPoint> FinitePoints(const PointCloud& cloud) {
  std::vector<IndexedPoint> points;
  points.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud[i];
    if (!p.allFinite()) continue;
    points.push_back({{p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(i)});
  }
  return points;
}

}  // namespace

SearchStatistics& SearchStatistics::operator+=(const SearchStatistics& other) {
  queries += other.queries;
  leaves_visited += other.leaves_visited;
  proven_unchanged += other.proven_unchanged;
  started_below_root += other.started_below_root;
  return *this;
}

KdTree::KdTree(const PointCloud& cloud, const KdTreeOptions& options)
    : bucket_size_(options.bucket_size), simd_(AvailableSimd(options.simd)) {
  assert(options.bucket_size >= 1 && "a bucket holds at least one point");
  std::vector<IndexedPoint> points = FinitePoints(cloud);
  if (points.empty()) return;
  size_ = Builder(layout_, static_cast<std::size_t>(options.bucket_size)).Build(points);
}

std::optional<Neighbor> KdTree::FindNearest(const Eigen::Vector3d& query_m,
                                            double max_distance_m,
                                            SearchStatistics* statistics) const {
  return FindNearestApproximately(query_m, 0.0, max_distance_m, statistics);
}

std::optional<Neighbor> KdTree::FindNearestApproximately(const Eigen::Vector3d& query_m,
                                                         double relative_error,
                                                         double max_distance_m,
                                                         SearchStatistics* statistics) const {
  assert(relative_error >= 0.0 && "an error bound is not negative");
  if (empty()) return std::nullopt;
  const double limit2_m2 = max_distance_m * max_distance_m;
  const SearchRequest request{
      .query_m = {query_m.x(), query_m.y(), query_m.z()},
      .limit2_m2 = limit2_m2,
      .prune_scale = 1.0 / ((1.0 + relative_error) * (1.0 + relative_error)),
  };
  SearchAnswer answer{};
  KernelFor(simd_).search(ViewOf(layout_), request, answer);
  if (statistics != nullptr) {
    *statistics += {.queries = 1, .leaves_visited = answer.leaves_visited};
  }
  if (answer.slot == KdTreeLayout::kNoSlot || !(answer.distance2_m2 < limit2_m2)) {
    return std::nullopt;
  }
  return Neighbor{.index = layout_.index_of_slot[answer.slot], .distance2_m2 = answer.distance2_m2};
}

}  // namespace slam6d
