// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "slam6d/cloud/octree.hpp"
#include "slam6d/cloud/reduction.hpp"
#include "slam6d/search/kd_tree.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PointCloud CloudOf(std::initializer_list<Eigen::Vector3d> points_m) {
  PointCloud cloud;
  for (const Eigen::Vector3d& point_m : points_m) cloud.push_back(point_m);
  return cloud;
}

TEST(Octree, HoldsEveryPointInTheCubeOfItsPlace) {
  const PointCloud cloud = ScanRoom({}, 5000, 0.01, 1);
  const Octree octree(cloud, 0.25);
  std::set<CubePlace> places;
  std::size_t points = 0;
  for (std::size_t cube = 0; cube < octree.size(); ++cube) {
    EXPECT_TRUE(places.insert(octree.place(cube)).second) << "a cube twice";
    points += octree.points(cube).size();
    for (const std::uint32_t i : octree.points(cube)) {
      EXPECT_EQ(PlaceOf(cloud[i], octree.origin_m(), octree.cube_m()), octree.place(cube));
    }
  }
  EXPECT_EQ(points, cloud.size());
}

TEST(Octree, LeavesOutWhatIsNoPlace) {
  const Octree octree(CloudOf({{0, 0, 0}, {kNaN, 0, 0}, {1, kInfinity, 0}, {0, 1e300, 0}}), 0.1);
  EXPECT_EQ(octree.size(), 1U);
  EXPECT_EQ(Octree(PointCloud{}, 0.1).size(), 0U);
}

TEST(Octree, TakesLargerCubesForACloudTooWide) {
  const Octree octree(CloudOf({{0, 0, 0}, {5e6, 0, 0}}), 0.001);
  EXPECT_EQ(octree.size(), 2U);
  EXPECT_GT(octree.cube_m(), 1.0);
}

TEST(Octree, KeepsItsCubesWhereAFewPointsAreStray) {
  PointCloud cloud = ScanRoom({}, 5000, 0.01, 1);
  const auto cubes = static_cast<double>(Octree(cloud, 0.1).size());
  cloud.push_back({300e3, 2.0, 1.0});
  cloud.push_back({0.0, -300e3, 1.0});
  const Octree octree(cloud, 0.1);
  EXPECT_EQ(octree.cube_m(), 0.1);
  EXPECT_NEAR(static_cast<double>(octree.size()), cubes + 2.0, 0.2 * cubes);
  EXPECT_EQ(octree.points(octree.size() - 1).size() + octree.points(0).size(), 2U);
}

TEST(Reduction, KeepsNothingOrAllAsAsked) {
  const PointCloud cloud = ScanRoom({}, 100, 0.01, 2);
  EXPECT_EQ(Reduce(cloud, {.voxel_m = 0.0}).size(), cloud.size());
  EXPECT_EQ(Reduce(cloud, {.voxel_m = 1000.0}).size(), 1U);
  EXPECT_TRUE(Reduce(PointCloud{}, {.voxel_m = 0.1}).empty());
}

TEST(Reduction, StandsForEveryPointWithinItsCube) {
  const PointCloud cloud = ScanRoom({}, 4000, 0.01, 3);
  const double diagonal_m = 0.2 * std::sqrt(3.0);
  for (const auto& [name, keep] : Names(ReductionChoice{})) {
    SCOPED_TRACE(name);
    const PointCloud reduced = Reduce(cloud, {.voxel_m = 0.2, .keep = keep});
    EXPECT_EQ(reduced.size(), Octree(cloud, 0.2).size());
    const KdTree tree(reduced);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_TRUE(tree.FindNearest(cloud[i], diagonal_m).has_value());
    }
  }
}

TEST(Reduction, DrawsTheSamePointsForTheSameSeed) {
  const PointCloud cloud = ScanRoom({}, 3000, 0.01, 4);
  ReductionOptions options{
      .voxel_m = 0.5, .keep = ReductionChoice::kRandom, .points_per_voxel = 3, .seed = 7};
  const PointCloud first = Reduce(cloud, options);
  const PointCloud again = Reduce(cloud, options);
  options.seed = 8;
  const PointCloud other = Reduce(cloud, options);
  ASSERT_EQ(first.size(), again.size());
  ASSERT_EQ(first.size(), other.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i], again[i]);
    different += first[i] == other[i] ? 0 : 1;
  }
  EXPECT_GT(different, first.size() / 4);
}

}  // namespace
}  // namespace slam6d
