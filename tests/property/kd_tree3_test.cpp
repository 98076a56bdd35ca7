// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The 3D searches against a comparison with every point. Distances are compared, to the last bit:
// which of two points at the same distance is returned is not defined.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "slam6d/search/cached_search.hpp"
#include "slam6d/search/kd_tree.hpp"

namespace slam6d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr SimdLevel kLevels[] = {SimdLevel::kPortable, SimdLevel::kAvx2, SimdLevel::kAvx512};

/// In the order of the searches: (x + y) + z.
double SquaredDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double x = a.x() - b.x();
  const double y = a.y() - b.y();
  const double z = a.z() - b.z();
  return x * x + y * y + z * z;
}

/// Squared distance of the nearest point nearer than `max_distance_m`, or infinity.
double BruteForce2(const PointCloud& cloud, const Eigen::Vector3d& query, double max_distance_m) {
  double best2 = kInfinity;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    best2 = std::min(best2, SquaredDistance(cloud[i], query));
  }
  return best2 < max_distance_m * max_distance_m ? best2 : kInfinity;
}

double Distance2(const std::optional<Neighbor>& neighbor) {
  return neighbor ? neighbor->distance2_m2 : kInfinity;
}

Eigen::Vector3d DrawPoint(std::mt19937& random, double scale_m) {
  std::normal_distribution<double> coordinate_m(0.0, scale_m);
  const double x = coordinate_m(random);
  const double y = coordinate_m(random);
  return {x, y, coordinate_m(random)};
}

enum class Shape { kBlob, kSurface, kGrid, kLine, kCopies, kScales };
constexpr Shape kShapes[] = {
    Shape::kBlob, Shape::kSurface, Shape::kGrid, Shape::kLine, Shape::kCopies, Shape::kScales};

Eigen::Vector3d DrawPoint(Shape shape, std::mt19937& random) {
  const Eigen::Vector3d p = DrawPoint(random, 10.0);
  switch (shape) {
    case Shape::kBlob:
      return p;
    case Shape::kSurface:
      return {p.x(), p.y(), 0.01 * p.z()};
    case Shape::kGrid:  // Many points at the same distance, many equal ones.
      return {std::round(p.x() / 4.0), std::round(p.y() / 4.0), std::round(p.z() / 4.0)};
    case Shape::kLine:
      return {p.x(), 1.0, -2.0};
    case Shape::kCopies:
      return p.x() < 0.0 ? Eigen::Vector3d(1.0, 2.0, 3.0) : p;
    case Shape::kScales:  // Middle cuts would need a level per power of two.
      return std::exp2(-60.0 * std::abs(p.x())) * p;
  }
  return p;
}

PointCloud DrawCloud(Shape shape, std::size_t size, std::mt19937& random) {
  PointCloud cloud;
  for (std::size_t i = 0; i < size; ++i) cloud.push_back(DrawPoint(shape, random));
  return cloud;
}

TEST(KdTree3, EqualsBruteForce) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const PointCloud cloud = DrawCloud(kShapes[seed % 6], 1 + 37 * seed, random);
    const KdTree tree(cloud,
                      {.bucket_size = 1 + static_cast<int>(seed), .simd = kLevels[seed % 3]});
    for (int i = 0; i < 200; ++i) {
      const double max_distance_m = i % 3 == 0 ? kInfinity : 0.1 * i;
      const Eigen::Vector3d query = DrawPoint(random, i % 2 == 0 ? 10.0 : 1000.0);
      EXPECT_EQ(Distance2(tree.FindNearest(query, max_distance_m)),
                BruteForce2(cloud, query, max_distance_m));
    }
  }
}

TEST(KdTree3, ReturnsThePointThatHasTheDistance) {
  std::mt19937 random(1);
  const PointCloud cloud = DrawCloud(Shape::kCopies, 500, random);
  const KdTree tree(cloud);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d query = DrawPoint(random, 10.0);
    const std::optional<Neighbor> neighbor = tree.FindNearest(query);
    ASSERT_TRUE(neighbor);
    EXPECT_EQ(SquaredDistance(cloud[neighbor->index], query), neighbor->distance2_m2);
  }
}

TEST(KdTree3, StoresEqualPointsOnceAndLeavesOutWhatIsNoNumber) {
  PointCloud cloud;
  for (int i = 0; i < 5000; ++i) cloud.push_back({1.0, 2.0, 3.0});
  cloud.push_back({std::nan(""), 0.0, 0.0});
  cloud.push_back({0.0, kInfinity, 0.0});
  cloud.push_back({4.0, 5.0, 6.0});
  const KdTree tree(cloud, {.bucket_size = 1});
  EXPECT_EQ(tree.size(), 2U);
  EXPECT_EQ(tree.FindNearest({1.0, 2.0, 3.5})->distance2_m2, 0.25);
  EXPECT_EQ(tree.FindNearest({1.0, 2.0, 3.5})->index, 0U);
  EXPECT_EQ(tree.FindNearest({4.0, 5.0, 7.0})->index, 5002U);
}

TEST(KdTree3, FindsNothingWhereThereIsNothing) {
  EXPECT_FALSE(KdTree(PointCloud{}).FindNearest({0.0, 0.0, 0.0}));
  PointCloud one;
  one.push_back({1.0, 0.0, 0.0});
  EXPECT_FALSE(KdTree(one).FindNearest({0.0, 0.0, 0.0}, 1.0));
  EXPECT_TRUE(KdTree(one).FindNearest({0.0, 0.0, 0.0}, 1.001));
  EXPECT_FALSE(KdTree(one).FindNearest({std::nan(""), 0.0, 0.0}));
}

TEST(KdTree3, ApproximateSearchKeepsItsErrorBoundAndVisitsFewerLeaves) {
  std::mt19937 random(5);
  const PointCloud cloud = DrawCloud(Shape::kBlob, 5000, random);
  const KdTree tree(cloud, {.bucket_size = 4});
  SearchStatistics exact;
  SearchStatistics approximate;
  int worse = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d query = DrawPoint(random, 10.0);
    const double nearest2 = Distance2(tree.FindNearest(query, kInfinity, &exact));
    const double found2 =
        Distance2(tree.FindNearestApproximately(query, 1.0, kInfinity, &approximate));
    EXPECT_LE(std::sqrt(found2), 2.0 * std::sqrt(nearest2) * (1.0 + 1e-12));
    worse += found2 > nearest2 ? 1 : 0;
  }
  EXPECT_LT(3 * approximate.leaves_visited, 2 * exact.leaves_visited);
  EXPECT_GT(worse, 0);
}

/// A pose that moves on as in a registration, except that now and then it jumps anywhere.
Pose3 Moved(const Pose3& pose, int step, std::mt19937& random) {
  const bool jump = step % 7 == 6;
  const double size = jump ? 30.0 : std::exp2(-step);
  const Pose3 motion{.rotation = RotationFromVector(DrawPoint(random, 0.1 * size)),
                     .translation_m = DrawPoint(random, size)};
  return motion * pose;
}

void ExpectBruteForce(const PointCloud& cloud,
                      const PointCloud& queries,
                      double max_distance_m,
                      const CachedSearch& search) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double expected2 = BruteForce2(cloud, queries[i], max_distance_m);
    ASSERT_EQ(search.found(i), expected2 < kInfinity) << i;
    if (!search.found(i)) continue;
    ASSERT_EQ(search.distance2_m2(i), expected2) << i;
    ASSERT_EQ(SquaredDistance(search.neighbor_m(i), queries[i]), expected2) << i;
    ASSERT_EQ(search.neighbor_m(i), cloud[search.neighbor_index(i)]) << i;
  }
}

TEST(CachedSearch3, EqualsBruteForceForAnyMotion) {
  SearchStatistics total;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const PointCloud cloud = DrawCloud(kShapes[seed % 6], 1 + 37 * seed, random);
    const KdTree tree(cloud,
                      {.bucket_size = 1 + static_cast<int>(seed % 9), .simd = kLevels[seed % 3]});
    const double max_distance_m = seed % 2 == 0 ? 3.0 : kInfinity;
    // Floats are off by centimetres there.
    const Eigen::Vector3d far_off_m = Eigen::Vector3d::UnitX() * (seed % 5 == 0 ? 3e5 : 0.0);
    const PointCloud queries = DrawCloud(kShapes[seed % 6], 203, random);
    CachedSearch search(tree, queries, {.max_distance_m = max_distance_m});
    Pose3 pose{.translation_m = far_off_m};
    for (int step = 0; step < 20; ++step) {
      SCOPED_TRACE(step);
      search.MoveTo(pose);
      total += search.Find(0, 104);
      total += search.Find(104, queries.size());
      ExpectBruteForce(cloud, pose * queries, max_distance_m, search);
      pose = Moved(pose, step, random);
    }
  }
  EXPECT_EQ(total.queries, 24U * 20U * 203U);
  EXPECT_GT(total.proven_unchanged, 0U);
  EXPECT_GT(total.started_below_root, 0U);
}

TEST(CachedSearch3, ProvesThatNeighborsOfStandingQueriesAreUnchanged) {
  std::mt19937 random(3);
  const PointCloud cloud = DrawCloud(Shape::kSurface, 2000, random);
  const KdTree tree(cloud);
  const PointCloud queries = DrawCloud(Shape::kSurface, 500, random);
  CachedSearch search(tree, queries, {});
  search.MoveTo({});
  EXPECT_EQ(search.Find(0, queries.size()).proven_unchanged, 0U);
  const SearchStatistics again = search.Find(0, queries.size());
  EXPECT_EQ(again.proven_unchanged, queries.size());
  EXPECT_EQ(again.leaves_visited, 0U);
}

TEST(CachedSearch3, TellsApartWhatFloatsDoNot) {
  std::mt19937 random(5);
  PointCloud cloud;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d place_m = DrawPoint(Shape::kBlob, random);
    for (int k = 0; k < 4; ++k) cloud.push_back(place_m + DrawPoint(random, 1e-7));
  }
  const PointCloud queries = DrawCloud(Shape::kBlob, 400, random);
  for (const SimdLevel level : kLevels) {
    const KdTree tree(cloud, {.simd = level});
    CachedSearch search(tree, queries, {});
    Pose3 pose;
    for (int step = 0; step < 6; ++step) {
      search.MoveTo(pose);
      search.Find(0, queries.size());
      ExpectBruteForce(cloud, pose * queries, kInfinity, search);
      pose = Moved(pose, step, random);
    }
  }
}

// Their squares are no floats.
TEST(CachedSearch3, TellsApartWhatIsNextToItsOrigin) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    PointCloud cloud;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p_m = DrawPoint(random, std::exp2(-40.0 - i));
      cloud.push_back(p_m);
      cloud.push_back(-p_m);
    }
    const KdTree tree(cloud, {.simd = kLevels[seed % 3]});
    CachedSearch search(tree, cloud, {});
    search.MoveTo({});
    for (int i = 0; i < 2; ++i) {
      search.Find(0, cloud.size());
      ExpectBruteForce(cloud, cloud, kInfinity, search);
    }
  }
}

// As a point that is none, in a file or of a scanner that was dazzled.
TEST(CachedSearch3, LooksAtNoMoreLeavesForAPointThatIsFarOff) {
  const auto visited_with = [](const std::vector<Eigen::Vector3d>& strays_m) {
    std::mt19937 random(7);
    PointCloud cloud = DrawCloud(Shape::kSurface, 5000, random);
    const PointCloud queries = DrawCloud(Shape::kSurface, 500, random);
    for (const Eigen::Vector3d& stray_m : strays_m) cloud.push_back(stray_m);
    const KdTree tree(cloud);
    CachedSearch search(tree, queries, {});
    search.MoveTo({});
    const SearchStatistics statistics = search.Find(0, queries.size());
    ExpectBruteForce(cloud, queries, kInfinity, search);
    return statistics.leaves_visited;
  };
  const auto usual = visited_with({});
  EXPECT_LT(visited_with({{1e6, 1e6, 1e6}}), 2 * usual);
  EXPECT_LT(visited_with({{1e7, -1e7, 1e7}, {3e38, 0.0, 0.0}}), 2 * usual);
}

TEST(CachedSearch3, GivesTheSameBitsAtEveryWidth) {
  std::mt19937 random(4);
  const PointCloud cloud = DrawCloud(Shape::kGrid, 3000, random);
  const PointCloud queries = DrawCloud(Shape::kBlob, 300, random);
  std::vector<std::size_t> expected;
  for (const SimdLevel level : kLevels) {
    const KdTree tree(cloud, {.simd = level});
    std::mt19937 motion(9);
    Pose3 pose;
    CachedSearch search(tree, queries, {});
    std::vector<std::size_t> neighbors;
    for (int step = 0; step < 12; ++step) {
      search.MoveTo(pose);
      search.Find(0, queries.size());
      for (std::size_t i = 0; i < queries.size(); ++i)
        neighbors.push_back(search.neighbor_index(i));
      pose = Moved(pose, step, motion);
    }
    if (expected.empty()) expected = neighbors;
    EXPECT_EQ(neighbors, expected);
  }
}

TEST(CachedSearch3, FindsNothingInAnEmptyTreeAndSurvivesQueriesThatAreNoNumbers) {
  const KdTree empty(PointCloud{});
  PointCloud queries(20);
  CachedSearch nothing(empty, queries, {});
  nothing.MoveTo({});
  nothing.Find(0, queries.size());
  EXPECT_FALSE(nothing.found(3));

  std::mt19937 random(6);
  const PointCloud cloud = DrawCloud(Shape::kBlob, 100, random);
  const KdTree tree(cloud);
  queries.Set(3, {std::nan(""), 0.0, 0.0});
  CachedSearch search(tree, queries, {});
  for (int i = 0; i < 3; ++i) {
    search.MoveTo({});
    search.Find(0, queries.size());
    EXPECT_FALSE(search.found(3));
    EXPECT_EQ(search.distance2_m2(4), BruteForce2(cloud, queries[4], kInfinity));
  }
}

}  // namespace
}  // namespace slam6d
