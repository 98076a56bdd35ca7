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

  // Cells may be moved by up to kMargin.
  static constexpr int kMargin = LikelihoodWindow::kBlocks * LikelihoodWindow::kBlockSide;
  LikelihoodWindow Window(std::uint8_t max_drift_code) {
    return {pyramid_,
            {{kLow.x - kMargin, kLow.y - kMargin}, {kHigh.x + kMargin, kHigh.y + kMargin}},
            max_drift_code,
            memory_};
  }
  GridCell AnyCell() {
    return {std::uniform_int_distribution<int>(kLow.x, kHigh.x)(random_),
            std::uniform_int_distribution<int>(kLow.y, kHigh.y)(random_)};
  }
  std::vector<GridCell> AnyCells(int count) {
    std::vector<GridCell> cells;
    for (int i = 0; i < count; ++i) cells.push_back(AnyCell());
    return cells;
  }
  // As the pyramid tells it.
  int LikelihoodAt(GridCell cell, std::uint8_t max_drift_code) const {
    const bool counts = max_drift_code == LikelihoodPyramid::kUnmapped ||
                        pyramid_.DriftCodeAt(0, cell.x, cell.y) <= max_drift_code;
    return counts ? pyramid_.LikelihoodAt(0, cell.x, cell.y) : 0;
  }
  int SumAt(std::span<const GridCell> cells, GridCell offset, std::uint8_t max_drift_code) const {
    int sum = 0;
    for (const GridCell& cell : cells) {
      sum += LikelihoodAt({cell.x + offset.x, cell.y + offset.y}, max_drift_code);
    }
    return sum;
  }

  // Placed an area before the offset along both axes.
  static std::vector<LikelihoodWindow::Bounds> BoundsOf(LikelihoodWindow& window,
                                                        std::span<const CellBox> boxes,
                                                        GridCell offset) {
    std::vector<LikelihoodWindow::Bounds> bounds(boxes.size());
    const auto places = window.PlacesOf(boxes, {offset.x - kMargin, offset.y - kMargin});
    window.BoundsOf(places, {1, 1}, bounds);
    return bounds;
  }

  static constexpr int kSide = LikelihoodWindow::kBlockSide;
  static constexpr int kBlocks = LikelihoodWindow::kBlocks;
  static constexpr int kPair = LikelihoodWindow::kPairSide;
  const std::array<std::uint8_t, 2> drift_codes_ = {LikelihoodPyramid::kUnmapped,
                                                    LikelihoodPyramid::DriftCode(0.2)};
  std::mt19937_64 random_;
  SearchMemory memory_;
  LikelihoodPyramid pyramid_;
};

TEST_P(AnyWindow, SumsTheCellsMovedByEachOffsetOfABlock) {
  const std::vector<GridCell> cells = AnyCells(700);  // More than a sum of 16 bits would hold.
  for (const std::uint8_t max_drift_code : drift_codes_) {
    LikelihoodWindow window = Window(max_drift_code);
    const GridCell first{-3, 5};
    const auto sums = window.SumsOfBlock(cells, first, {});
    for (int i = 0; i < kSide * kSide; ++i) {
      const GridCell offset{first.x + i % kSide, first.y + i / kSide};
      EXPECT_EQ(sums[static_cast<std::size_t>(i)], SumAt(cells, offset, max_drift_code));
    }
  }
}

TEST_P(AnyWindow, BoundsPairsOfOffsetsByThreeCellsAndSumsThem) {
  const std::vector<GridCell> cells = AnyCells(300);
  for (const std::uint8_t max_drift_code : drift_codes_) {
    LikelihoodWindow window = Window(max_drift_code);
    const GridCell first{-7, 3};
    const auto bounds = window.BoundsOfPairs(cells, first, {});
    for (int i = 0; i < kBlocks * kBlocks; ++i) {
      const GridCell pair{first.x + i % kBlocks * kPair, first.y + i / kBlocks * kPair};
      const auto sums = window.SumsOfPair(cells, pair);
      for (int k = 0; k < kPair * kPair; ++k) {
        const GridCell offset{pair.x + k % kPair, pair.y + k / kPair};
        EXPECT_EQ(sums[static_cast<std::size_t>(k)], SumAt(cells, offset, max_drift_code));
      }
      EXPECT_LE(*std::ranges::max_element(sums), bounds[static_cast<std::size_t>(i)]);
    }
  }
}

/// What a cell meets at most that is anywhere in a box and moved by any offset of a block.
TEST_P(AnyWindow, BoundsABlockOfOffsetsForACellAnywhereInABox) {
  for (const std::uint8_t max_drift_code : drift_codes_) {
    LikelihoodWindow window = Window(max_drift_code);
    for (int trial = 0; trial < 60; ++trial) {
      // From one cell to much more than any square that is kept.
      const int widest = trial % 3 == 0 ? 200 : 20;
      CellBox box{.low = AnyCell(), .high = {}};
      box.high = {std::min(kHigh.x, box.low.x + std::uniform_int_distribution(0, widest)(random_)),
                  std::min(kHigh.y, box.low.y + std::uniform_int_distribution(0, widest)(random_))};
      const GridCell first{trial % 7 - 3, trial % 5 - 2};
      const auto bounds = BoundsOf(window, std::span(&box, 1), first);
      for (int i = 0; i < kBlocks * kBlocks; i += 5) {
        const int column = i % kBlocks;
        const int row = i / kBlocks;
        int greatest = 0;
        for (int y = box.low.y; y <= box.high.y + kSide - 1; ++y) {
          for (int x = box.low.x; x <= box.high.x + kSide - 1; ++x) {
            const GridCell cell{x + first.x + column * kSide, y + first.y + row * kSide};
            if (cell.x > kHigh.x || cell.y > kHigh.y) continue;  // Not in the window.
            greatest = std::max(greatest, LikelihoodAt(cell, max_drift_code));
          }
        }
        ASSERT_LE(greatest, bounds.front().At(column, row));
      }
    }
  }
}

TEST_P(AnyWindow, BoundsOfSmallBoxesReachNoFurtherThanTheCoarseCellsAbout) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  constexpr int kCoarse = 1 << LikelihoodTile::ShiftOf(1);
  for (int trial = 0; trial < 200; ++trial) {
    CellBox box{.low = AnyCell(), .high = {}};
    box.high = {box.low.x + trial % 9, box.low.y + trial % 4};
    int greatest = 0;
    const auto down = [](int cell) { return cell & ~(kCoarse - 1); };
    for (int y = down(box.low.y); y < down(box.high.y + kSide - 1) + kCoarse; ++y) {
      for (int x = down(box.low.x); x < down(box.high.x + kSide - 1) + kCoarse; ++x) {
        greatest = std::max<int>(greatest, pyramid_.LikelihoodAt(0, x, y));
      }
    }
    EXPECT_EQ(BoundsOf(window, std::span(&box, 1), {0, 0}).front().At(0, 0), greatest);
  }
}

TEST_P(AnyWindow, SumsTheBoundsOfManyCells) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  std::vector<CellBox> boxes;
  for (const GridCell& cell : AnyCells(600)) boxes.push_back({cell, {cell.x + 5, cell.y + 2}});
  const auto bounds = BoundsOf(window, boxes, {0, 0});
  for (int rows = 1; rows <= kBlocks; ++rows) {
    const auto sums = LikelihoodWindow::SumsOf(bounds, rows);
    for (int i = 0; i < rows * kBlocks; ++i) {
      int expected = 0;
      for (const auto& bound : bounds) expected += bound.At(i % kBlocks, i / kBlocks);
      EXPECT_EQ(sums[static_cast<std::size_t>(i)], expected);
    }
  }
}

TEST_P(AnyWindow, GivesUpOnlyWhereNoSumReachesWhatIsNeeded) {
  LikelihoodWindow window = Window(LikelihoodPyramid::kUnmapped);
  const std::vector<GridCell> cells = AnyCells(300);
  const GridCell first{-3, 5};
  std::vector<int> rest;  // As high as it can be, after the first few cells, twice as many ..
  for (std::size_t i = LikelihoodWindow::kCellsAtATime; i < cells.size();
       i += LikelihoodWindow::kCellsAtATime) {
    const auto sums = window.SumsOfBlock(std::span(cells).subspan(i), first, {});
    rest.push_back(*std::ranges::max_element(sums));
  }
  const auto sums = window.SumsOfBlock(cells, first, {});
  const int largest = *std::ranges::max_element(sums);
  EXPECT_EQ(window.SumsOfBlock(cells, first, {.needed = largest, .rest = rest}), sums);
  const auto fewer = window.SumsOfBlock(cells, first, {.needed = largest + 1, .rest = rest});
  EXPECT_LE(*std::ranges::max_element(fewer), largest);
}

TEST_P(AnyWindow, ForgetsSurfacesOfMuchDrift) {
  LikelihoodPyramid pyramid;
  pyramid.Insert({0.0, 0.0}, 0.01);
  pyramid.Insert({2.0, 0.0}, 0.5);
  LikelihoodWindow window(pyramid, {kLow, kHigh}, LikelihoodPyramid::DriftCode(0.1), memory_);
  const auto at = [&](double x_m) {
    const GridCell cell{pyramid.CellIndex(x_m), 0};
    return window.SumsOfBlock(std::span(&cell, 1), {0, 0}, {}).front();
  };
  EXPECT_GT(at(0.0), 0);
  EXPECT_EQ(at(2.0), 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyWindow, testing::Range(0U, 5U));

}  // namespace
}  // namespace qwsm
