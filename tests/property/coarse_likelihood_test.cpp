// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// No pose of a block is more likely than the block's bound.
#include "qwsm/search/coarse_likelihood.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace qwsm {
namespace {

using Random = std::mt19937_64;

constexpr double kMapReach_m = 20.0;
constexpr int kScanReach = 60;  // In cells.

LikelihoodPyramid AnyMap(Random& random) {
  std::uniform_real_distribution<double> coordinate_m(-kMapReach_m, kMapReach_m);
  LikelihoodPyramid map;
  for (int i = 0; i < 800; ++i) map.Insert({coordinate_m(random), coordinate_m(random)}, 0.0);
  return map;
}

CoarseLikelihood BoundsOf(const LikelihoodPyramid& map) {
  const Eigen::Vector2d reach_m = Eigen::Vector2d::Constant(kMapReach_m + 20.0);
  return {map, {-reach_m, reach_m}};
}

std::vector<GridCell> AnyCells(Random& random, std::size_t count) {
  std::uniform_int_distribution<int> cell(-kScanReach, kScanReach);
  std::vector<GridCell> cells;
  for (std::size_t i = 0; i < count; ++i) cells.push_back({cell(random), cell(random)});
  return cells;
}

/// The cells at any offset of a square, each moved on by any cells up to a margin.
std::vector<GridCell> Moved(Random& random,
                            const std::vector<GridCell>& cells,
                            GridCell offset,
                            int margin) {
  std::uniform_int_distribution<int> step(-margin, margin);
  std::vector<GridCell> moved;
  for (const GridCell& cell : cells) {
    moved.push_back({cell.x + offset.x + step(random), cell.y + offset.y + step(random)});
  }
  return moved;
}

int SumOf(const LikelihoodPyramid& map, const std::vector<GridCell>& cells) {
  int sum = 0;
  for (const GridCell& cell : cells) sum += map.LikelihoodAt(0, cell.x, cell.y);
  return sum;
}

TEST(CoarseLikelihood, NoPoseOfABlockIsMoreLikelyThanItsBound) {
  constexpr std::size_t kNear = 20;
  constexpr std::size_t kFar = 10;
  constexpr double kFull = (kNear + kFar) * double{std::numeric_limits<std::uint8_t>::max()};
  Random random(1);
  const LikelihoodPyramid map = AnyMap(random);
  const CoarseLikelihood coarse = BoundsOf(map);
  for (int round = 0; round < 4000; ++round) {
    const int level = round % CoarseLikelihood::kLevels;
    SCOPED_TRACE(level);
    const int width = CoarseLikelihood::WidthOf(level);
    const std::vector<GridCell> near = AnyCells(random, kNear);
    const std::vector<GridCell> far = AnyCells(random, kFar);
    std::uniform_int_distribution<int> anywhere(-200, 200);
    const GridCell first{anywhere(random), anywhere(random)};
    const CoarseLikelihood::FourBounds bounds = coarse.BoundsOfFour(level, {near, far}, first, 0.0);
    std::uniform_int_distribution<int> in_square(0, width - 1);
    for (int i = 0; i < 4; ++i) {
      const GridCell offset{first.x + (i & 1) * width + in_square(random),
                            first.y + (i >> 1) * width + in_square(random)};
      const int sum = SumOf(map, Moved(random, near, offset, width / 8)) +
                      SumOf(map, Moved(random, far, offset, width / 4));
      ASSERT_LE(sum / kFull, bounds[static_cast<std::size_t>(i)] + 1e-9) << "square " << i;
    }
  }
}

TEST(CoarseLikelihood, BoundsEndNearWhatIsMapped) {
  LikelihoodPyramid map;
  map.Insert({0.0, 0.0}, 0.0);
  const GridCell point = map.CellAt({0.0, 0.0});
  const std::vector<GridCell> near = {point};
  const CoarseLikelihood coarse = BoundsOf(map);
  for (int level = 0; level < CoarseLikelihood::kLevels; ++level) {
    SCOPED_TRACE(level);
    const int width = CoarseLikelihood::WidthOf(level);
    const auto bound = [&](GridCell offset) {
      return coarse.BoundsOfFour(level, {near, {}}, offset, 0.0).front();
    };
    const double likely = map.LikelihoodAt(0, point.x, point.y) / 255.0;
    EXPECT_DOUBLE_EQ(bound({0, 0}), likely);
    // A likelihood reaches four sigmas, 5 cells, and a block twice its width.
    EXPECT_EQ(bound({2 * width + 6, 0}), 0.0);
    EXPECT_EQ(bound({0, -4 * width - 6}), 0.0);
  }
}

TEST(CoarseLikelihood, WhatCannotReachWhatIsNeededNeedNotBeSummedUp) {
  Random random(2);
  const LikelihoodPyramid map = AnyMap(random);
  const CoarseLikelihood coarse = BoundsOf(map);
  int reached = 0;
  for (int round = 0; round < 500; ++round) {
    const std::vector<GridCell> near = AnyCells(random, 40);
    const double needed = 0.3;
    const auto all = coarse.BoundsOfFour(3, {near, {}}, {0, 0}, 0.0);
    const auto some = coarse.BoundsOfFour(3, {near, {}}, {0, 0}, needed);
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_LE(some[i], all[i]);
      if (all[i] < needed) continue;
      EXPECT_EQ(some[i], all[i]);
      ++reached;
    }
  }
  EXPECT_GT(reached, 20);
}

}  // namespace
}  // namespace qwsm
