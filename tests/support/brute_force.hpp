// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "qwsm/search/point_quadtree.hpp"

/// Brute force, and what a quadtree's searches have to find by it.
namespace qwsm::test {

/// What is in the tree, in the order of ids: positions are the tree's, searches are brute force.
class BruteForce {
 public:
  explicit BruteForce(const PointQuadtree& tree) {
    tree.ForEach([this](PointId id, const Eigen::Vector2d& p_m) { points_.emplace(id, p_m); });
  }

  /// Distances not above the bound, of the points that are accepted, in ascending order.
  template <class Accept>
  std::vector<double> Distances(const Eigen::Vector2d& query_m,
                                double max_distance_m,
                                Accept accept) const {
    std::vector<double> distances_m;
    for (const auto& [id, p_m] : points_) {
      if (accept(id)) distances_m.push_back((p_m - query_m).norm());
    }
    std::ranges::sort(distances_m);
    const auto beyond = std::ranges::upper_bound(distances_m, max_distance_m);
    distances_m.erase(beyond, distances_m.end());
    return distances_m;
  }

  template <class Predicate>
  std::set<PointId> Where(Predicate predicate) const {
    std::set<PointId> ids;
    for (const auto& [id, p_m] : points_) {
      if (predicate(p_m)) ids.insert(id);
    }
    return ids;
  }

  std::size_t size() const { return points_.size(); }
  const Eigen::Vector2d& at(PointId id) const { return points_.at(id); }

 private:
  std::map<PointId, Eigen::Vector2d> points_;
};

/// Rounding of doubles: of positions in metres, which grows with the distance from the origin, and
/// of queries, which the tree takes to 2^-22 cell.
inline double Rounding(const PointQuadtree& tree, const Eigen::Vector2d& p_m) {
  return 4e-15 * p_m.cwiseAbs().maxCoeff() + 1e-6 * tree.options().cell_size_m;
}

inline void ExpectNeighbor(const PointQuadtree& tree,
                           const BruteForce& truth,
                           const Eigen::Vector2d& query_m,
                           const std::vector<double>& expected_m,
                           const std::optional<Neighbor>& neighbor) {
  ASSERT_EQ(neighbor.has_value(), !expected_m.empty());
  if (!neighbor) return;
  const double tolerance_m = Rounding(tree, query_m) + 1e-12 * expected_m.front();
  EXPECT_NEAR(std::sqrt(neighbor->distance_m2), expected_m.front(), tolerance_m);
  ASSERT_TRUE(tree.Contains(neighbor->id));
  EXPECT_EQ(neighbor->position_m, truth.at(neighbor->id));
  EXPECT_NEAR((neighbor->position_m - query_m).norm(), expected_m.front(), tolerance_m);
}

inline void ExpectAllSearchesExact(const PointQuadtree& tree,
                                   const Eigen::Vector2d& query_m,
                                   double max_distance_m) {
  const BruteForce truth(tree);
  const auto any = [](PointId) { return true; };
  const std::vector<double> distances_m = truth.Distances(query_m, max_distance_m, any);
  ExpectNeighbor(tree, truth, query_m, distances_m, tree.Nearest(query_m, max_distance_m));

  const auto some = [](PointId id) { return id % 7 == 3; };
  const std::vector<double> some_m = truth.Distances(query_m, max_distance_m, some);
  ExpectNeighbor(tree, truth, query_m, some_m, tree.NearestIf(query_m, max_distance_m, some));

  for (const std::size_t k : {1, 3, 30}) {
    std::vector<Neighbor> nearest = {Neighbor{}, Neighbor{}};
    tree.KNearest(query_m, k, max_distance_m, nearest);
    ASSERT_EQ(nearest.size(), std::min(k, distances_m.size()));
    std::set<PointId> ids;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      const double tolerance_m = Rounding(tree, query_m) + 1e-12 * distances_m[i];
      EXPECT_NEAR(std::sqrt(nearest[i].distance_m2), distances_m[i], tolerance_m);
      ids.insert(nearest[i].id);
    }
    EXPECT_EQ(ids.size(), nearest.size());
  }
}

inline void ExpectRegionsExact(const PointQuadtree& tree,
                               const Eigen::Vector2d& center_m,
                               double size_m) {
  const BruteForce truth(tree);
  std::set<PointId> found;
  const auto collect = [&](PointId id, const Eigen::Vector2d& position_m) {
    EXPECT_EQ(position_m, truth.at(id));
    EXPECT_TRUE(found.insert(id).second) << "visited twice";
  };
  tree.ForEachInRadius(center_m, size_m, collect);
  const double slack_m = Rounding(tree, center_m) + 1e-12 * size_m;
  const auto inner =
      truth.Where([&](const auto& p) { return (p - center_m).norm() < size_m - slack_m; });
  const auto outer =
      truth.Where([&](const auto& p) { return (p - center_m).norm() < size_m + slack_m; });
  EXPECT_TRUE(std::ranges::includes(found, inner));
  EXPECT_TRUE(std::ranges::includes(outer, found));
  for (const int at_most : {0, 1, 5, 1000000}) {
    EXPECT_EQ(tree.CountInRadius(center_m, size_m, at_most),
              std::min(at_most, static_cast<int>(found.size())));
  }

  found.clear();
  const Eigen::Vector2d half_m(size_m, size_m / 3);
  const Eigen::Vector2d slack2_m(slack_m, slack_m);
  tree.ForEachInBox(Eigen::AlignedBox2d(center_m - half_m, center_m + half_m), collect);
  const Eigen::AlignedBox2d smaller(center_m - half_m + slack2_m, center_m + half_m - slack2_m);
  const Eigen::AlignedBox2d larger(center_m - half_m - slack2_m, center_m + half_m + slack2_m);
  EXPECT_TRUE(std::ranges::includes(
      found, truth.Where([&](const auto& p) { return smaller.contains(p); })));
  EXPECT_TRUE(
      std::ranges::includes(truth.Where([&](const auto& p) { return larger.contains(p); }), found));
}

}  // namespace qwsm::test
