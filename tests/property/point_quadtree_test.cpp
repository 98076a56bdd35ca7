// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/point_quadtree.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/brute_force.hpp"
#include "tests/support/point_clouds.hpp"

namespace qwsm::test {
namespace {

TEST(PointQuadtree, SearchesEqualBruteForce) {
  for (int seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const Setting& setting = Settings()[static_cast<std::size_t>(seed) % Settings().size()];
    PointQuadtree tree;
    for (const auto& p_m : Cloud(random, setting.center_m, setting.extent_m, seed % 5)) {
      ASSERT_TRUE(tree.Insert(p_m, 0));
    }
    for (int i = 0; i < 20; ++i) {
      SCOPED_TRACE(i);
      const Eigen::Vector2d query_m =
          PointInSquare(random, setting.center_m, 1.2 * setting.extent_m);
      const double size_m = setting.extent_m * std::pow(10.0, Uniform(random, -4.0, 0.2));
      ExpectAllSearchesExact(tree, query_m, i % 3 == 0 ? kInfinity : size_m);
      ExpectRegionsExact(tree, query_m, size_m);
    }
  }
}

// All in one leaf, on a circle about the query, but for some micrometres that floats do not show.
TEST(PointQuadtree, TellsApartWhatIsAlmostEquallyFar) {
  for (const double radius_m : {0.1, 1.0, 10.0, 400.0}) {
    SCOPED_TRACE(radius_m);
    Random random(1);
    for (int i = 0; i < 200; ++i) {
      PointQuadtree tree;
      const Eigen::Vector2d query_m = PointInSquare(random, {3.0, -5.0}, radius_m);
      for (int point = 0; point < 15; ++point) {
        const double angle_rad = Uniform(random, -3.14, 3.14);
        const double distance_m = radius_m + 2e-6 * Uniform(random, 0.0, 10.0);
        tree.Insert(
            query_m + distance_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)), 0);
      }
      ExpectAllSearchesExact(tree, query_m, kInfinity);
    }
  }
}

TEST(PointQuadtree, SearchAtStoredPointsFindsThem) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const Setting& setting = Settings()[static_cast<std::size_t>(seed) % Settings().size()];
    PointQuadtree tree;
    for (const auto& p_m : Cloud(random, setting.center_m, setting.extent_m, seed % 5))
      tree.Insert(p_m, 0);
    const Points positions_m = tree.Positions();
    for (PointId id = 0; id < tree.id_end(); ++id) {
      const auto neighbor = tree.Nearest(positions_m[id], 0.0);
      if (setting.center_m.cwiseAbs().maxCoeff() < 1e5) {  // Further out doubles round positions.
        ASSERT_TRUE(neighbor);
        EXPECT_EQ(neighbor->id, id);
        EXPECT_EQ(neighbor->distance_m2, 0.0);
      }
    }
  }
}

TEST(PointQuadtree, CachedSearchEqualsUncachedWhateverTheSteps) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const Setting& setting = Settings()[static_cast<std::size_t>(seed) % Settings().size()];
    PointQuadtree tree;
    ScanId scan = 0;
    Eigen::Vector2d query_m = setting.center_m;
    SearchCursor cursor;
    double max_distance_m = kInfinity;
    for (int i = 0; i < 1500; ++i) {
      if (i % 500 == 0) {
        for (const auto& p_m : Cloud(random, setting.center_m, setting.extent_m, seed % 5))
          tree.Insert(p_m, scan);
        ++scan;
      }
      if (random() % 40 == 0) tree.Insert(query_m + AnyStep(random, setting.extent_m), scan);
      if (random() % 400 == 0) tree.RemoveScan(static_cast<ScanId>(random() % scan));
      if (random() % 20 == 0)
        query_m = PointInSquare(random, setting.center_m, 1.2 * setting.extent_m);
      if (random() % 50 == 0)
        max_distance_m = random() % 2 == 0 ? kInfinity : AnyStep(random, setting.extent_m).norm();
      query_m += AnyStep(random, setting.extent_m * 1e-2);
      const auto uncached = tree.Nearest(query_m, max_distance_m);
      const auto cached = tree.Nearest(query_m, max_distance_m, cursor);
      ASSERT_EQ(cached.has_value(), uncached.has_value()) << i;
      if (!cached) continue;
      ASSERT_DOUBLE_EQ(cached->distance_m2, uncached->distance_m2) << i;
      EXPECT_EQ(cached->position_m, tree.Positions()[cached->id]);
    }
  }
}

TEST(PointQuadtree, CursorOfAnotherTreeIsNotUsed) {
  PointQuadtree left;
  PointQuadtree right;
  left.Insert({-1.0, 0.0}, 0);
  right.Insert({1.0, 0.0}, 0);
  SearchCursor cursor;
  EXPECT_EQ(left.Nearest({0.1, 0.0}, 10.0, cursor)->position_m.x(), -1.0);
  EXPECT_EQ(right.Nearest({0.1, 0.0}, 10.0, cursor)->position_m.x(), 1.0);
  PointQuadtree copy = right;
  copy.Insert({0.2, 0.0}, 0);
  right.Insert({0.5, 0.0}, 0);
  EXPECT_EQ(copy.Nearest({0.1, 0.0}, 10.0, cursor)->position_m.x(), 0.2);
  EXPECT_EQ(right.Nearest({0.1, 0.0}, 10.0, cursor)->position_m.x(), 0.5);
}

TEST(PointQuadtree, BoundIncludesPointsExactlyAtIt) {
  PointQuadtree tree;
  tree.Insert({0.25, 0.0}, 0);
  for (int i = 0; i < 100; ++i) tree.Insert({-1.0, 0.01 * i}, 0);
  EXPECT_TRUE(tree.Nearest({0.0, 0.0}, 0.25));
  EXPECT_FALSE(tree.Nearest({0.0, 0.0}, 0.2499999));
  int count = 0;
  tree.ForEachInRadius({0.0, 0.0}, 0.25, [&](PointId, const Eigen::Vector2d&) { ++count; });
  tree.ForEachInBox({Eigen::Vector2d(0.25, 0.0), Eigen::Vector2d(0.25, 0.0)},
                    [&](PointId, const Eigen::Vector2d&) { ++count; });
  EXPECT_EQ(count, 2);
}

}  // namespace
}  // namespace qwsm::test
