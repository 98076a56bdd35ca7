// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

  // Blocks that begin at any cell are in it.
  LikelihoodWindow Window(std::uint8_t max_drift_code) const {
    constexpr int kMargin = LikelihoodWindow::kBlockSide - 1;
    return {pyramid_, kLow, {kHigh.x + kMargin, kHigh.y + kMargin}, max_drift_code};
  }
  GridCell AnyCell() {
    return {std::uniform_int_distribution<int>(kLow.x, kHigh.x)(random_),
            std::uniform_int_distribution<int>(kLow.y, kHigh.y)(random_)};
  }
  static int At(LikelihoodWindow& window, int level, GridCell cell) {
    return level == 0 ? window.SumsOfBlock(std::span(&cell, 1), {0, 0}).front()
                      : window.Bound(level, std::span(&cell, 1), {0, 0});
  }

  std::mt19937_64 random_;
  LikelihoodPyramid pyramid_;
};

TEST_P(AnyWindow, ReadsWhatThePyramidHolds) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    for (int trial = 0; trial < 500; ++trial) {
      const GridCell cell = AnyCell();
      EXPECT_EQ(At(window, level, cell), pyramid_.LikelihoodAt(level, cell.x, cell.y));
    }
  }
}

TEST_P(AnyWindow, SumsTheCellsMovedByEachOffsetOfABlock) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  std::vector<GridCell> cells;  // More than a sum of 16 bits would hold.
  for (int i = 0; i < 700; ++i) cells.push_back({(i * 7) % 50 - 25, (i * 11) % 40 - 20});
  const GridCell first{-3, 5};
  constexpr int kSide = LikelihoodWindow::kBlockSide;
  const auto sums = window.SumsOfBlock(cells, first);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      int expected = 0;
      for (const GridCell& cell : cells) {
        expected += pyramid_.LikelihoodAt(0, cell.x + first.x + x, cell.y + first.y + y);
      }
      EXPECT_EQ(sums[static_cast<std::size_t>(y * kSide + x)], expected);
      for (int level = 1; level < LikelihoodPyramid::kLevels; ++level) {
        EXPECT_LE(expected, window.Bound(level, cells, first));
      }
    }
  }
}

TEST_P(AnyWindow, BoundsPairsOfOffsetsAndSumsThem) {
  LikelihoodWindow window = Window(LikelihoodPyramid::DriftCode(0.2));
  std::vector<GridCell> cells;
  for (int i = 0; i < 300; ++i) cells.push_back({(i * 7) % 50 - 25, (i * 11) % 40 - 20});
  const GridCell first{-7, 3};
  constexpr int kSide = LikelihoodWindow::kBlockSide;
  constexpr int kPair = LikelihoodWindow::kPairSide;
  const auto bounds = window.BoundsOfPairs(cells, first, {});
  for (int i = 0; i < kSide * kSide; ++i) {
    const GridCell pair{first.x + i % kSide * kPair, first.y + i / kSide * kPair};
    const auto sums = window.SumsOfPair(cells, pair);
    const auto of_block = window.SumsOfBlock(cells, pair);
    EXPECT_EQ(sums,
              (std::array<int, 4>{of_block[0], of_block[1], of_block[kSide], of_block[kSide + 1]}));
    EXPECT_LE(*std::ranges::max_element(sums), bounds[static_cast<std::size_t>(i)]);
  }
}

TEST_P(AnyWindow, GivesUpOnlyWhereNoSumReachesWhatIsNeeded) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  std::vector<GridCell> cells;
  for (int i = 0; i < 300; ++i) cells.push_back({(i * 7) % 50 - 25, (i * 11) % 40 - 20});
  const GridCell first{-3, 5};
  const auto sums = window.SumsOfBlock(cells, first);
  const int largest = *std::ranges::max_element(sums);
  const int bound = window.Bound(LikelihoodWindow::kBlockLevel, cells, first);
  EXPECT_EQ(window.SumsOfBlock(cells, first, {.bound = bound, .needed = largest}), sums);
  const auto fewer = window.SumsOfBlock(cells, first, {.bound = bound, .needed = largest + 1});
  EXPECT_LE(*std::ranges::max_element(fewer), largest);
}

TEST_P(AnyWindow, BoundsWhatABeamMovedWithinACellMeetsAmongSurfacesOfLittleDrift) {
  LikelihoodWindow window = Window(LikelihoodPyramid::DriftCode(0.2));
  for (int trial = 0; trial < 500; ++trial) {
    const GridCell cell = AnyCell();
    for (int level = 1; level < LikelihoodPyramid::kLevels; ++level) {
      const int bound = At(window, level, cell);
      const int side = 1 << LikelihoodTile::ShiftOf(level);
      for (int y = cell.y; y < std::min(kHigh.y, cell.y + side); ++y) {
        for (int x = cell.x; x < std::min(kHigh.x, cell.x + side); ++x) {
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
  LikelihoodWindow window(pyramid, kLow, kHigh, LikelihoodPyramid::DriftCode(0.1));
  EXPECT_GT(At(window, 0, {pyramid.CellIndex(0.0), 0}), 0);
  EXPECT_EQ(At(window, 0, {pyramid.CellIndex(2.0), 0}), 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyWindow, testing::Range(0U, 5U));

}  // namespace
}  // namespace qwsm
