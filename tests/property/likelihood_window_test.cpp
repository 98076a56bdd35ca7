// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <vector>

namespace qwsm {
namespace {

constexpr GridCell kLow{-70, -45};
constexpr GridCell kHigh{95, 81};

class AnyWindow : public testing::TestWithParam<unsigned> {
 protected:
  AnyWindow() : random_(GetParam()) {
    std::uniform_real_distribution<double> anywhere_m(-6.0, 6.0);
    std::uniform_real_distribution<double> drift_m2(1e-6, 1.0);
    for (int i = 0; i < 60; ++i) {
      const double x_m = anywhere_m(random_);
      pyramid_.Insert({x_m, anywhere_m(random_)}, drift_m2(random_));
    }
  }

  GridCell AnyCell() {
    return {std::uniform_int_distribution<int>(kLow.x, kHigh.x)(random_),
            std::uniform_int_distribution<int>(kLow.y, kHigh.y)(random_)};
  }
  static int At(const LikelihoodWindow& window, int level, GridCell cell) {
    return window.Sum(level, std::span(&cell, 1), {0, 0});
  }

  std::mt19937_64 random_;
  LikelihoodPyramid pyramid_;
};

TEST_P(AnyWindow, ReadsWhatThePyramidHolds) {
  const LikelihoodWindow window(pyramid_, kLow, kHigh, LikelihoodPyramid::kUnmapped);
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    for (int trial = 0; trial < 500; ++trial) {
      const GridCell cell = AnyCell();
      EXPECT_EQ(At(window, level, cell), pyramid_.LikelihoodAt(level, cell.x, cell.y));
    }
  }
}

TEST_P(AnyWindow, SumsTheCellsMovedByAnOffset) {
  const LikelihoodWindow window(pyramid_, kLow, kHigh, LikelihoodPyramid::kUnmapped);
  const std::vector<GridCell> cells = {{0, 0}, {5, -7}, {13, 22}};
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    const GridCell offset{-(1 << level), 2 << level};
    int expected = 0;
    for (const GridCell& cell : cells) {
      expected += pyramid_.LikelihoodAt(level, cell.x + offset.x, cell.y + offset.y);
    }
    EXPECT_EQ(window.Sum(level, cells, offset), expected);
  }
}

TEST_P(AnyWindow, BoundsWhatABeamMovedWithinACellMeetsAmongSurfacesOfLittleDrift) {
  const LikelihoodWindow window(pyramid_, kLow, kHigh, LikelihoodPyramid::DriftCode(0.2));
  for (int trial = 0; trial < 500; ++trial) {
    const GridCell cell = AnyCell();
    for (int level = 1; level < LikelihoodPyramid::kLevels; ++level) {
      const int bound = At(window, level, cell);
      for (int y = cell.y; y < std::min(kHigh.y, cell.y + (1 << level)); ++y) {
        for (int x = cell.x; x < std::min(kHigh.x, cell.x + (1 << level)); ++x) {
          ASSERT_LE(At(window, 0, {x, y}), bound);
        }
      }
    }
  }
}

TEST_P(AnyWindow, ForgetsSurfacesOfMuchDrift) {
  LikelihoodPyramid pyramid;
  pyramid.Insert({0.0, 0.0}, 0.01);
  pyramid.Insert({2.0, 0.0}, 0.5);
  const LikelihoodWindow window(pyramid, kLow, kHigh, LikelihoodPyramid::DriftCode(0.1));
  EXPECT_GT(At(window, 0, {pyramid.CellIndex(0.0), 0}), 0);
  EXPECT_EQ(At(window, 0, {pyramid.CellIndex(2.0), 0}), 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyWindow, testing::Range(0U, 5U));

}  // namespace
}  // namespace qwsm
