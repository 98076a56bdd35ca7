// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace qwsm {
namespace {

/// Points anywhere on either side of the origin, some far out.
LikelihoodPyramid AnyPyramid(std::mt19937_64& random, std::vector<Eigen::Vector2d>& points_m) {
  LikelihoodPyramid pyramid;
  std::uniform_real_distribution<double> near_m(-6.0, 6.0);
  std::uniform_real_distribution<double> drift_m2(1e-6, 1.0);
  for (int i = 0; i < 40; ++i) {
    Eigen::Vector2d p_m(near_m(random), near_m(random));
    if (i % 10 == 0) p_m *= 100.0;
    points_m.push_back(p_m);
    pyramid.Insert(p_m, drift_m2(random));
  }
  return pyramid;
}

TEST(LikelihoodPyramid, IsTheGreatestLikelihoodOfAllPoints) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<Eigen::Vector2d> points_m;
    const LikelihoodPyramid pyramid = AnyPyramid(random, points_m);
    const double sigma_m = LikelihoodPyramidOptions{}.sigma_m;
    for (int x = -95; x < 95; ++x) {
      for (int y = -95; y < 95; ++y) {
        const Eigen::Vector2d cell_m = pyramid.cell_size_m() * Eigen::Vector2d(x + 0.5, y + 0.5);
        double nearest_m = 1e9;
        for (const auto& p_m : points_m) nearest_m = std::min(nearest_m, (p_m - cell_m).norm());
        const double expected = std::exp(-0.5 * std::pow(nearest_m / sigma_m, 2));
        const double likelihood = pyramid.LikelihoodAt(0, x, y) / 255.0;
        EXPECT_LE(likelihood, expected + 1e-9);
        // What is left out is hardly likely.
        if (nearest_m < 2.0 * sigma_m) {
          EXPECT_GT(likelihood, expected - 1.01 / 255.0);
        }
      }
    }
  }
}

TEST(LikelihoodPyramid, HigherLevelsBoundWhatABeamMovedWithinThemMeets) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<Eigen::Vector2d> points_m;
    const LikelihoodPyramid pyramid = AnyPyramid(random, points_m);
    std::uniform_int_distribution<int> any_cell(-110, 110);
    for (int trial = 0; trial < 2000; ++trial) {
      const int x = any_cell(random);
      const int y = any_cell(random);
      for (int level = 1; level < LikelihoodPyramid::kLevels; ++level) {
        const int bound = pyramid.LikelihoodAt(level, x, y);
        const int side = 1 << LikelihoodTile::ShiftOf(level);
        for (int dy = 0; dy < side; ++dy) {
          for (int dx = 0; dx < side; ++dx) {
            ASSERT_LE(pyramid.LikelihoodAt(0, x + dx, y + dy), bound);
          }
        }
      }
    }
  }
}

TEST(LikelihoodPyramid, HoldsTheSmallestDrift) {
  LikelihoodPyramid pyramid;
  pyramid.Insert({1.0, 1.0}, 0.04);
  pyramid.Insert({1.05, 1.0}, 0.01);
  pyramid.Insert({1.1, 1.0}, 0.09);
  const int cell = pyramid.CellIndex(1.05);
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    EXPECT_EQ(pyramid.DriftCodeAt(level, cell, pyramid.CellIndex(1.0)),
              LikelihoodPyramid::DriftCode(0.01));
  }
}

TEST(LikelihoodPyramid, DriftCodesAreMonotoneAndNearlyExact) {
  std::uint8_t last = 0;
  for (double drift_m2 = 1e-6; drift_m2 < 1e3; drift_m2 *= 1.01) {
    const std::uint8_t code = LikelihoodPyramid::DriftCode(drift_m2);
    EXPECT_GE(code, last);
    last = code;
    EXPECT_NEAR(LikelihoodPyramid::DriftOf(code) / drift_m2, 1.0, 0.08);
  }
  EXPECT_LT(LikelihoodPyramid::DriftCode(1e300), LikelihoodPyramid::kUnmapped);
  EXPECT_EQ(LikelihoodPyramid::DriftCode(0.0), 0);
}

TEST(LikelihoodPyramid, IsEmptyWhereNothingWasStored) {
  LikelihoodPyramid pyramid;
  EXPECT_EQ(pyramid.LikelihoodAt(0, 0, 0), 0);
  pyramid.Insert({1.0, -2.0}, 1e-4);
  EXPECT_GT(pyramid.LikelihoodAt(0, pyramid.CellIndex(1.0), pyramid.CellIndex(-2.0)), 200);
  EXPECT_EQ(pyramid.LikelihoodAt(0, 2'000'000'000, -2'000'000'000), 0);
  EXPECT_EQ(pyramid.DriftCodeAt(0, 0, 0), LikelihoodPyramid::kUnmapped);
}

}  // namespace
}  // namespace qwsm
