// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <algorithm>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

}  // namespace

LikelihoodWindow::LikelihoodWindow(const LikelihoodPyramid& pyramid,
                                   GridCell low,
                                   GridCell high,
                                   std::uint8_t max_drift_code)
    : first_tile_{low.x >> Tile::kBits, low.y >> Tile::kBits},
      size_{(high.x >> Tile::kBits) - first_tile_.x + 1,
            (high.y >> Tile::kBits) - first_tile_.y + 1} {
  const std::vector<const Tile*> tiles = pyramid.FindTiles(first_tile_, size_);
  for (int level = 0; level < Tile::kLevels; ++level) {
    planes_.emplace_back(Tile::kSide >> Tile::ShiftOf(level), size_);
    ForEachTile(tiles, [&](const Tile& tile, GridCell at) {
      planes_.back().Place(tile.likelihoods(level), at);
    });
  }
  if (max_drift_code != LikelihoodPyramid::kUnmapped) ForgetDrifted(tiles, max_drift_code);
}

LikelihoodWindow::BlockSums LikelihoodWindow::SumsOfBlock(std::span<const GridCell> cells,
                                                          GridCell offset,
                                                          int rows) const {
  constexpr std::size_t kAtATime = 256;  // So many likelihoods fit a sum of 16 bits.
  const Plane& plane = planes_.front();
  const int x = offset.x - first_tile_.x * Tile::kSide;
  const int y = offset.y - first_tile_.y * Tile::kSide;
  BlockSums sums{};
  while (!cells.empty()) {
    const auto next = cells.first(std::min(cells.size(), kAtATime));
    cells = cells.subspan(next.size());
    std::array<std::uint16_t, std::tuple_size_v<BlockSums>> of_next{};
    for (const GridCell& cell : next) {
      const std::uint8_t* from = plane.RowAt(cell.x + x, cell.y + y);
      for (int row = 0; row < rows; ++row, from += plane.width) {
        std::uint16_t* const to = &of_next[static_cast<std::size_t>(row * kBlockSide)];
        for (int column = 0; column < kBlockSide; ++column) to[column] += from[column];
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += of_next[i];
  }
  return sums;
}

template <class Visit>
void LikelihoodWindow::ForEachTile(std::span<const Tile* const> tiles, Visit visit) const {
  auto tile = tiles.begin();
  for (int row = 0; row < size_.y; ++row) {
    for (int column = 0; column < size_.x; ++column, ++tile) visit(**tile, GridCell{column, row});
  }
}

// Sets the likelihood of cells to 0 that no surface with little drift is in.
void LikelihoodWindow::ForgetDrifted(std::span<const Tile* const> tiles,
                                     std::uint8_t max_drift_code) {
  for (int level = 0; level < Tile::kLevels; ++level) {
    const int shift = Tile::ShiftOf(level);
    const int drift_shift = Tile::DriftShiftOf(level);
    Plane drift(Tile::kSide >> drift_shift, size_);
    ForEachTile(tiles,
                [&](const Tile& tile, GridCell at) { drift.Place(tile.drift_codes(level), at); });
    // Drift cells that hold the level-0 cells a cell is the maximum over.
    const auto first_of = [&](int cell) { return (cell << shift) >> drift_shift; };
    const auto last_of = [&](int cell) {
      return ((cell << shift) + (2 << shift) - 2) >> drift_shift;
    };
    Plane& plane = planes_[static_cast<std::size_t>(level)];
    for (int y = 0; y < plane.height; ++y) {
      for (int x = 0; x < plane.width; ++x) {
        if (plane.At(x, y) == 0) continue;
        const std::uint8_t smallest =
            drift.Smallest({first_of(x), first_of(y)}, {last_of(x), last_of(y)});
        if (smallest > max_drift_code) plane.At(x, y) = 0;
      }
    }
  }
}

// Puts the rows of a tile in their place.
void LikelihoodWindow::Plane::Place(const std::uint8_t* tile, GridCell at) {
  for (int y = 0; y < side; ++y) {
    std::copy_n(tile + y * side, side, &At(at.x * side, at.y * side + y));
  }
}

// Of the cells low .. high that the plane has.
std::uint8_t LikelihoodWindow::Plane::Smallest(GridCell low, GridCell high) const {
  std::uint8_t smallest = LikelihoodPyramid::kUnmapped;
  for (int y = low.y; y <= std::min(high.y, height - 1); ++y) {
    for (int x = low.x; x <= std::min(high.x, width - 1); ++x)
      smallest = std::min(smallest, At(x, y));
  }
  return smallest;
}

}  // namespace qwsm
