// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/surface_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace qwsm {
namespace {

using Random = std::mt19937_64;

/// Some noisy walls and a few scattered points, inserted scan by scan.
std::vector<std::pair<MapPoint, ScanId>> AnyScans(Random& random, int scans) {
  std::uniform_real_distribution<double> along_m(-1.0, 1.0);
  std::normal_distribution<double> noise_m(0.0, 0.01);
  std::vector<std::pair<MapPoint, ScanId>> points;
  for (int scan = 0; scan < scans; ++scan) {
    for (int i = 0; i < 60; ++i) {
      Eigen::Vector2d p_m(along_m(random), 0.4 * (i % 3) + noise_m(random));
      if (i % 20 == 0) p_m = {along_m(random), along_m(random)};
      points.push_back({{.p_map_m = p_m,
                         .normal_map = {0.0, 1.0},
                         .spacing_m = 0.03,
                         .drift_m2 = 1e-4 * (scan + 1)},
                        static_cast<ScanId>(scan)});
    }
  }
  return points;
}

/// Mean of the stored points around one of them, itself included.
Eigen::Vector2d MeanAround(const SurfaceMap& map,
                           const Eigen::Vector2d& center_m,
                           double radius_m) {
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  int count = 0;
  map.quadtree().ForEach([&](PointId, const Eigen::Vector2d& p_m) {
    if ((p_m - center_m).norm() > radius_m) return;
    sum_m += p_m;
    ++count;
  });
  return sum_m / count;
}

void ExpectSurfacesOfBruteForce(const SurfaceMap& map) {
  const SurfaceMapOptions options;
  map.quadtree().ForEach([&](PointId id, const Eigen::Vector2d& p_m) {
    const Surface surface = map.SurfaceAt({.id = id, .position_m = p_m});
    // Where few points are around, the scan's own normal and the point itself are all there is.
    const bool is_own = (surface.mean_m - p_m).norm() < 1e-12;
    if (is_own) return;
    const Eigen::Vector2d mean_m = MeanAround(map, p_m, options.neighborhood_radius_m);
    EXPECT_NEAR((surface.mean_m - mean_m).norm(), 0.0, 1e-5) << id;
    EXPECT_NEAR(surface.normal.norm(), 1.0, 1e-9) << id;
    EXPECT_GE(surface.across_m2, 0.0) << id;
  });
}

TEST(SurfaceMap, SurfacesAreThoseOfThePointsAround) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    SurfaceMap map;
    for (const auto& [point, scan] : AnyScans(random, 6)) ASSERT_TRUE(map.Insert(point, scan));
    ExpectSurfacesOfBruteForce(map);
  }
}

TEST(SurfaceMap, ForMatchingHasTheSameSurfacesAndMakesTheLikelihoodWhenAsked) {
  Random random(7);
  SurfaceMap searched;
  SurfaceMap matched = SurfaceMap::ForMatching({});
  for (const auto& [point, scan] : AnyScans(random, 6)) {
    searched.Insert(point, scan);
    matched.Insert(point, scan);
  }
  EXPECT_LT(matched.bytes(), searched.bytes());
  ExpectSurfacesOfBruteForce(matched);
  const LikelihoodPyramid made = matched.MakeLikelihood();
  for (int x = -20; x < 20; ++x) {
    for (int y = -20; y < 20; ++y) {
      EXPECT_NEAR(made.LikelihoodAt(0, x, y), searched.likelihood().LikelihoodAt(0, x, y), 1);
      EXPECT_EQ(made.DriftCodeAt(0, x, y), searched.likelihood().DriftCodeAt(0, x, y));
    }
  }
}

TEST(SurfaceMap, AWallIsALineAcrossItsNormal) {
  Random random(1);
  std::normal_distribution<double> noise_m(0.0, 0.004);
  SurfaceMap map;
  const Eigen::Vector2d along(std::cos(0.7), std::sin(0.7));
  const Eigen::Vector2d normal(-along.y(), along.x());
  for (int i = 0; i < 100; ++i) {
    map.Insert({.p_map_m = 0.01 * i * along + noise_m(random) * normal},
               static_cast<ScanId>(i % 4));
  }
  const auto middle = map.quadtree().Nearest(0.5 * along, 0.1);
  ASSERT_TRUE(middle);
  const Surface surface = map.SurfaceAt(*middle);
  EXPECT_TRUE(surface.is_line);
  EXPECT_GT(std::abs(surface.normal.dot(normal)), std::cos(0.05));
  EXPECT_LT(surface.across_m2, 0.02 * 0.02);
}

// Of points of an arc, the mean lies behind them by a sixth of the square of the reach over the
// radius: of half the reach, by a quarter of that.
TEST(SurfaceMap, NearPointsHaveAMeanThatLiesLessBehindACurve) {
  constexpr double kRadius_m = 0.4;
  SurfaceMap map;
  for (int i = -200; i <= 200; ++i) {
    const double angle_rad = 0.005 * i;
    map.Insert({.p_map_m = kRadius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad))},
               0);
  }
  const auto front = map.quadtree().Nearest({kRadius_m, 0.0}, 0.01);
  ASSERT_TRUE(front);
  const double depth_m = kSurfaceReach_m * kSurfaceReach_m / (6.0 * kRadius_m);
  EXPECT_NEAR(front->position_m.x() - map.SurfaceAt(*front).mean_m.x(), depth_m, 0.1 * depth_m);
  EXPECT_NEAR(front->position_m.x() - map.MeanNear(*front).x(), 0.25 * depth_m, 0.05 * depth_m);
}

// Where matching asks often they are kept as points come, else searched for.
TEST(SurfaceMap, TellsTheMeanOfNearPointsKeptOrSearched) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> any_m(-0.15, 0.15);
  SurfaceMap searched;
  SurfaceMap kept = SurfaceMap::ForMatching({});
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p_m(3.0 + any_m(random), -2.0 + any_m(random));
    for (SurfaceMap* map : {&searched, &kept}) map->Insert({.p_map_m = p_m}, 0);
    if (i % 10 > 0) continue;
    kept.quadtree().ForEach([&](PointId id, const Eigen::Vector2d& p_map_m) {
      const Neighbor stored{.id = id, .position_m = p_map_m};
      EXPECT_LT((kept.MeanNear(stored) - searched.MeanNear(stored)).norm(), 1e-6);
    });
  }
}

TEST(SurfaceMap, TheSidesOfAThinWallAreTwoSurfaces) {
  SurfaceMap map;
  const Eigen::Vector2d left(0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    map.Insert({.p_map_m = {0.02 * i, 0.05}, .normal_map = left}, 0);
    map.Insert({.p_map_m = {0.02 * i, -0.05}, .normal_map = -left}, 1);
  }
  const auto nearest = map.quadtree().Nearest({0.4, 0.05}, 0.01);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(map.SurfaceAt(*nearest).mean_m.y(), 0.05, 1e-5);
  EXPECT_NEAR(map.MeanNear(*nearest).y(), 0.05, 1e-5);
  EXPECT_TRUE(map.IsOnOtherSide(nearest->id, -left));
  EXPECT_FALSE(map.IsOnOtherSide(nearest->id, left));
  EXPECT_FALSE(map.IsOnOtherSide(nearest->id, Eigen::Vector2d(1.0, 0.0)));  // Around the corner.
  EXPECT_FALSE(map.IsOnOtherSide(nearest->id, Eigen::Vector2d::Zero()));
}

TEST(SurfaceMap, RefusesWhatIsNoPlace) {
  SurfaceMap map;
  EXPECT_FALSE(map.Insert({.p_map_m = {std::nan(""), 0.0}}, 0));
  EXPECT_TRUE(map.empty());
}

}  // namespace
}  // namespace qwsm
