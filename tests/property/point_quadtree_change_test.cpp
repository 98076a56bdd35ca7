// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "qwsm/search/point_quadtree.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/point_clouds.hpp"

namespace qwsm::test {
namespace {

/// What is known about one cell, kept beside the tree.
struct ExpectedCell {
  std::vector<std::pair<ScanId, Eigen::Vector2d>> contributions;

  Eigen::Vector2d Mean() const {
    Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
    for (const auto& [scan, p_m] : contributions) sum_m += p_m;
    return sum_m / static_cast<double>(contributions.size());
  }
};

TEST(PointQuadtree, MergesPerCellAndRemovesScansExactly) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const double cell_m = seed % 2 == 0 ? 0.001 : 0.05;
    const Eigen::Vector2d center_m =
        seed % 3 == 0 ? Eigen::Vector2d(1e4, -2e4) : Eigen::Vector2d(0, 0);
    PointQuadtree tree({.cell_size_m = cell_m});
    std::map<std::pair<double, double>, ExpectedCell> expected;
    std::map<std::pair<double, double>, PointId> ids;
    const auto check = [&] {
      ASSERT_EQ(tree.size(), expected.size());
      const Points positions_m = tree.Positions();
      for (const auto& [cell, truth] : expected) {
        const PointId id = ids.at(cell);
        ASSERT_TRUE(tree.Contains(id));
        EXPECT_EQ(tree.Count(id), truth.contributions.size());
        EXPECT_EQ(tree.Scan(id), truth.contributions.front().first);
        EXPECT_LE((positions_m[id] - truth.Mean()).cwiseAbs().maxCoeff(), 0.0021 * cell_m);
      }
    };
    for (ScanId scan = 0; scan < 12; ++scan) {
      for (int i = 0; i < 200; ++i) {
        const Eigen::Vector2d p_m = PointInSquare(random, center_m, 12 * cell_m);
        const Eigen::Vector2d cell = (p_m * (1.0 / cell_m)).array().floor();
        const auto insertion = tree.Insert(p_m, scan);
        ASSERT_TRUE(insertion);
        auto& truth = expected[{cell.x(), cell.y()}];
        ASSERT_EQ(insertion->merged, !truth.contributions.empty());
        if (insertion->merged) {
          ASSERT_EQ(insertion->id, ids.at({cell.x(), cell.y()}));
        }
        ids[{cell.x(), cell.y()}] = insertion->id;
        truth.contributions.emplace_back(scan, p_m);
      }
      if (scan % 3 == 2) {
        const auto removed = static_cast<ScanId>(random() % (scan + 1));
        std::size_t withdrawn = 0;
        for (auto& [cell, truth] : expected) {
          withdrawn +=
              std::erase_if(truth.contributions, [&](const auto& c) { return c.first == removed; });
        }
        std::erase_if(expected,
                      [](const auto& entry) { return entry.second.contributions.empty(); });
        EXPECT_EQ(tree.RemoveScan(removed), withdrawn);
        EXPECT_EQ(tree.RemoveScan(removed), 0U);
      }
      check();
      ExpectAllSearchesExact(tree, PointInSquare(random, center_m, 15 * cell_m), kInfinity);
    }
  }
}

TEST(PointQuadtree, RemovingAllLeavesNothing) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    PointQuadtree tree;
    for (int round = 0; round < 3; ++round) {
      const double extent_m = std::pow(10.0, Uniform(random, -1, 4));
      const auto cloud = Cloud(random, PointInSquare(random, {0, 0}, 1e6), extent_m, seed % 5);
      for (const auto& p_m : cloud)
        ASSERT_TRUE(tree.Insert(p_m, static_cast<ScanId>(random() % 3)));
      EXPECT_EQ(tree.RemoveScan(0) + tree.RemoveScan(1) + tree.RemoveScan(2), cloud.size());
      const PointQuadtreeStatistics statistics = tree.Statistics();
      EXPECT_EQ(statistics.points, 0U);
      EXPECT_EQ(statistics.nodes, 0U);
      EXPECT_EQ(statistics.merged_points, 0U);
      EXPECT_FALSE(tree.Nearest(cloud.front(), kInfinity));
    }
    EXPECT_LE(tree.id_end(), 700U);
  }
}

TEST(PointQuadtree, IdsAreDenseAndStableUntilRemoved) {
  Random random(3);
  PointQuadtree tree;
  Points inserted_m;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector2d p_m(i * 0.01, Uniform(random, 0, 0.0009));
    EXPECT_EQ(tree.Insert(p_m, static_cast<ScanId>(i % 10))->id, static_cast<PointId>(i));
    inserted_m.push_back(p_m);
  }
  EXPECT_EQ(tree.RemoveScan(4), 500U);
  EXPECT_EQ(tree.size(), 4500U);
  const Points positions_m = tree.Positions();
  for (PointId id = 0; id < 5000; ++id) {
    ASSERT_EQ(tree.Contains(id), id % 10 != 4);
    if (id % 10 == 4) continue;
    EXPECT_NEAR((positions_m[id] - inserted_m[id]).norm(), 0.0, 1e-6);
  }
  EXPECT_FALSE(tree.Contains(5000));
  for (int i = 0; i < 500; ++i) EXPECT_EQ(tree.Insert({-1.0 - 0.01 * i, 0.0}, 11)->id % 10, 4U);
  EXPECT_EQ(tree.Insert({-10.0, 0.0}, 11)->id, 5000U);
}

TEST(PointQuadtree, KeepsMillimetresAThousandKilometresOut) {
  PointQuadtree tree;
  for (int i = 0; i < 100; ++i)
    EXPECT_FALSE(tree.Insert({1e6 + 0.001 * i + 0.0005, -1e6}, 0)->merged);
  EXPECT_EQ(tree.size(), 100U);
  for (int i = 0; i < 100; ++i) {
    const auto neighbor = tree.Nearest({1e6 + 0.001 * i + 0.0004, -1e6}, 0.0004);
    ASSERT_TRUE(neighbor);
    EXPECT_EQ(neighbor->id, static_cast<PointId>(i));
  }
}

TEST(PointQuadtree, RefusesPointsItCannotHold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  PointQuadtree tree;
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300}) {
    EXPECT_FALSE(tree.Insert({bad, 0.0}, 0));
    EXPECT_FALSE(tree.Insert({0.0, bad}, 0));
  }
  EXPECT_FALSE(tree.Insert({0.0, 0.0}, PointQuadtree::kScanEnd));
  EXPECT_TRUE(tree.empty());
  ASSERT_TRUE(tree.Insert({0.0, 0.0}, PointQuadtree::kScanEnd - 1));
  EXPECT_EQ(tree.Scan(0), PointQuadtree::kScanEnd - 1);
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e300, 3e6, -1.5e6}) {
    EXPECT_FALSE(tree.Insert({bad, 0.0}, 0));
    EXPECT_FALSE(tree.Insert({0.0, bad}, 0));
    EXPECT_FALSE(tree.Nearest({0.0, bad}, 1e3));
    SearchCursor cursor;
    EXPECT_FALSE(tree.Nearest({bad, 0.0}, 1e3, cursor));
    std::vector<Neighbor> neighbors;
    tree.KNearest({bad, bad}, 3, 1e3, neighbors);
    EXPECT_TRUE(neighbors.empty());
    tree.ForEachInRadius({bad, 0.0}, 1.0, [](PointId, const Eigen::Vector2d&) { FAIL(); });
  }
  EXPECT_FALSE(tree.Nearest({0.0, 0.0}, -1.0));
  EXPECT_FALSE(tree.Nearest({0.0, 0.0}, kNan));
  EXPECT_EQ(tree.size(), 1U);
  EXPECT_TRUE(tree.Insert({1.4e6, -1.4e6}, 0));
  EXPECT_NEAR(tree.Nearest({3e6, 0.0}, kInfinity)->position_m.x(), 1.4e6, 1e-6);
  for (const double bad_m : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THROW(PointQuadtree({.cell_size_m = bad_m}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace qwsm::test
