// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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

/// What the points give the cells of level 0, one exponential for each.
double LikelihoodOf(const std::vector<Eigen::Vector2d>& points_m,
                    const LikelihoodPyramid& pyramid,
                    const LikelihoodPyramidOptions& options,
                    GridCell cell) {
  const int reach = static_cast<int>(std::ceil(2.5 * options.sigma_m / options.cell_size_m));
  double greatest = 0.0;
  for (const Eigen::Vector2d& p_m : points_m) {
    const GridCell of_point = pyramid.CellAt(p_m);
    if (std::abs(cell.x - of_point.x) > reach || std::abs(cell.y - of_point.y) > reach) continue;
    const Eigen::Vector2d middle_m =
        options.cell_size_m * Eigen::Vector2d(cell.x + 0.5, cell.y + 0.5);
    const double sigmas2 = (middle_m - p_m).squaredNorm() / (options.sigma_m * options.sigma_m);
    greatest = std::max(greatest, 255.0 * std::exp(-0.5 * sigmas2));
  }
  return greatest;
}

TEST(LikelihoodPyramid, IsTheGaussianOfTheNearestPointWhateverTheCellsAndSigmas) {
  unsigned seed = 0;
  for (const double cell_size_m : {0.01, 0.064, 0.5, 1.0}) {
    for (const double sigma_m : {0.005, 0.08, 0.3}) {
      SCOPED_TRACE(testing::Message() << ++seed << ": " << cell_size_m << " " << sigma_m);
      std::mt19937_64 random(seed);
      const LikelihoodPyramidOptions options{.cell_size_m = cell_size_m, .sigma_m = sigma_m};
      LikelihoodPyramid pyramid(options);
      std::uniform_real_distribution<double> any_cell(-20.0, 20.0);
      std::vector<Eigen::Vector2d> points_m;
      for (int i = 0; i < 6; ++i) {
        points_m.emplace_back(cell_size_m * any_cell(random), cell_size_m * any_cell(random));
        pyramid.Insert(points_m.back(), 0.01);
      }
      for (int x = -60; x < 60; ++x) {
        for (int y = -60; y < 60; ++y) {
          const double expected = LikelihoodOf(points_m, pyramid, options, {x, y});
          EXPECT_LE(pyramid.LikelihoodAt(0, x, y), expected + 1e-6);
          EXPECT_GT(pyramid.LikelihoodAt(0, x, y), expected - 1.0 - 1e-6);
        }
      }
    }
  }
}

TEST(LikelihoodPyramid, CoarseCellsHoldTheGreatestOfTheirCellsAndNoMore) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::vector<Eigen::Vector2d> points_m;
    const LikelihoodPyramid pyramid = AnyPyramid(random, points_m);
    const int side = 1 << LikelihoodTile::ShiftOf(1);
    for (int x = -30 * side; x < 30 * side; x += side) {
      for (int y = -30 * side; y < 30 * side; y += side) {
        std::uint8_t greatest = 0;
        for (int dx = 0; dx < side; ++dx) {
          for (int dy = 0; dy < side; ++dy) {
            greatest = std::max(greatest, pyramid.LikelihoodAt(0, x + dx, y + dy));
          }
        }
        EXPECT_EQ(pyramid.LikelihoodAt(1, x, y), greatest) << x << " " << y;
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

TEST(LikelihoodPyramid, TellsTheSmallestDriftAroundACell) {
  std::mt19937_64 random(6);
  std::vector<Eigen::Vector2d> points_m;
  const LikelihoodPyramid pyramid = AnyPyramid(random, points_m);
  std::uniform_int_distribution<int> any_cell(-110, 110);
  for (int trial = 0; trial < 300; ++trial) {
    const GridCell center{any_cell(random), any_cell(random)};
    for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
      const int side = 1 << LikelihoodTile::DriftShiftOf(level);
      const int reach = trial % 4;
      std::uint8_t smallest = LikelihoodPyramid::kUnmapped;
      for (int dx = -reach; dx <= reach; ++dx) {
        for (int dy = -reach; dy <= reach; ++dy) {
          smallest = std::min(
              smallest, pyramid.DriftCodeAt(level, center.x + dx * side, center.y + dy * side));
        }
      }
      EXPECT_EQ(pyramid.SmallestDriftCode(level, center, reach), smallest);
    }
  }
}

TEST(LikelihoodPyramid, DriftCodesAreTheLogarithmRounded) {
  for (double drift_m2 = 1e-6; drift_m2 < 1e6; drift_m2 *= 1.0037) {
    const double steps = 5.0 * std::log2(drift_m2 / 1e-6);
    EXPECT_EQ(LikelihoodPyramid::DriftCode(drift_m2), std::lround(steps)) << drift_m2;
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
