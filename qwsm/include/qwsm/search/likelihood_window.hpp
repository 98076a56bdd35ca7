// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// The part of a likelihood pyramid that one search looks at, as plain arrays: a search reads each
/// cell many times, and reads it here at a tenth of the cost.
class LikelihoodWindow {
 public:
  /// @param low, high cells to be read, both included.
  /// @param max_drift_code what drifted more counts as unmapped.
  LikelihoodWindow(const LikelihoodPyramid& pyramid,
                   GridCell low,
                   GridCell high,
                   std::uint8_t max_drift_code);

  /// SumsOfBlock() sums all offsets of a block of this level at once.
  static constexpr int kBlockLevel = 1;
  static constexpr int kBlockSide = 1 << LikelihoodTile::ShiftOf(kBlockLevel);
  using BlockSums = std::array<int, std::size_t{kBlockSide} * kBlockSide>;

  /// Upper bound of the sums of the likelihoods of cells moved by any offset of a block that begins
  /// at one and is as wide as a cell of the level. @pre the moved cells are in the window, here and
  /// below
  int Bound(int level, std::span<const GridCell> cells, GridCell offset) const {
    const Plane& plane = planes_[static_cast<std::size_t>(level)];
    const int shift = LikelihoodTile::ShiftOf(level);
    const int x = offset.x - first_tile_.x * LikelihoodTile::kSide;
    const int y = offset.y - first_tile_.y * LikelihoodTile::kSide;
    int sum = 0;
    for (const GridCell& cell : cells) {
      sum += plane.At((cell.x + x) >> shift, (cell.y + y) >> shift);
    }
    return sum;
  }

  /// Sums of the likelihoods of cells moved by each offset of a block that begins at one, row by
  /// row. @param rows so many of the block's rows are wanted.
  BlockSums SumsOfBlock(std::span<const GridCell> cells, GridCell offset, int rows) const;

 private:
  // All cells of one level, row after row.
  struct Plane {
    // Of so many tiles; not filled yet.
    Plane(int tile_side, GridCell tiles)
        : side(tile_side),
          width(tiles.x * tile_side),
          height(tiles.y * tile_side),
          cells(std::make_unique_for_overwrite<std::uint8_t[]>(static_cast<std::size_t>(width) *
                                                               static_cast<std::size_t>(height))) {}

    const std::uint8_t* RowAt(int x, int y) const {
      return &cells[static_cast<std::size_t>(y * width + x)];
    }
    std::uint8_t At(int x, int y) const { return *RowAt(x, y); }
    std::uint8_t& At(int x, int y) { return cells[static_cast<std::size_t>(y * width + x)]; }
    void Place(const std::uint8_t* tile, GridCell at);
    std::uint8_t Smallest(GridCell low, GridCell high) const;

    int side;  // Of a tile.
    int width;
    int height;
    std::unique_ptr<std::uint8_t[]> cells;
  };

  template <class Visit>
  void ForEachTile(std::span<const LikelihoodTile* const> tiles, Visit visit) const;
  void ForgetDrifted(std::span<const LikelihoodTile* const> tiles, std::uint8_t max_drift_code);

  GridCell first_tile_;        // Its column and row.
  GridCell size_;              // How many columns and rows of tiles there are.
  std::vector<Plane> planes_;  // By level.
};

}  // namespace qwsm
