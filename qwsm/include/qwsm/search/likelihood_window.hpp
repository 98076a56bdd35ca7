// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// The part of a likelihood pyramid that one search looks at, as plain arrays: a search reads each
/// cell many times, and reads it here at a tenth of the cost. The coarse levels are copied at once;
/// of the finest one, a tile when something is first asked of it: a search that knows early where
/// to look pays for little more. Bounds of pairs of offsets along both axes are made likewise.
class LikelihoodWindow {
 public:
  /// Keeps references to tiles of the pyramid, which must not change meanwhile.
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
  /// at one and is as wide as a cell of the level. @pre level > 0, and the moved cells are in the
  /// window, here and below
  int Bound(int level, std::span<const GridCell> cells, GridCell offset) const {
    const Plane& plane = PlaneOf(level);
    const int shift = LikelihoodTile::ShiftOf(level);
    const int x = offset.x - first_tile_.x * LikelihoodTile::kSide;
    const int y = offset.y - first_tile_.y * LikelihoodTile::kSide;
    int sum = 0;
    for (const GridCell& cell : cells) {
      sum += plane.At((cell.x + x) >> shift, (cell.y + y) >> shift);
    }
    return sum;
  }

  /// Bounds of kBlockSide x kBlockSide blocks of a level side by side, of which the first begins at
  /// an offset, row by row. Blocks may lie beyond the window; their bounds say nothing.
  BlockSums BoundsOfBlocks(int level, std::span<const GridCell> cells, GridCell offset) const;

  /// What a search hopes of sums.
  struct Hope {
    int bound = 0;          ///< None of them is larger.
    int needed = 0;         ///< If none reaches it, all may be told lower than they are.
    int rows = kBlockSide;  ///< So many rows are wanted; others may be told as 0.
  };
  /// Sums of the likelihoods of cells moved by each offset of a block that begins at one, row by
  /// row. Offsets of the block may lead beyond the window; their sums say nothing.
  /// @param hope its bound is that of Bound().
  BlockSums SumsOfBlock(std::span<const GridCell> cells, GridCell offset, const Hope& hope);
  BlockSums SumsOfBlock(std::span<const GridCell> cells, GridCell offset) {
    return SumsOfBlock(cells, offset, {});
  }

  /// Side of the squares of offsets that BoundsOfPairs() bounds.
  static constexpr int kPairSide = 2;
  /// Bounds of the pairs by pairs of offsets of a block of the coarsest level, row by row.
  /// @param hope its bound is that of Bound().
  BlockSums BoundsOfPairs(std::span<const GridCell> cells, GridCell offset, const Hope& hope);
  /// Sums of the likelihoods of cells moved by one such pair by pair, row by row.
  std::array<int, 4> SumsOfPair(std::span<const GridCell> cells, GridCell offset);

 private:
  // All cells of one level, row after row, with margins to read blocks beyond.
  struct Plane {
    // Of so many tiles, filled with one value.
    Plane(int tile_side, GridCell tiles, std::uint8_t value)
        : side(tile_side),
          width(tiles.x * tile_side + kBlockSide),
          height(tiles.y * tile_side),
          cells(static_cast<std::size_t>(width * (height + kBlockSide)), value) {}

    const std::uint8_t& At(int x, int y) const {
      return cells[static_cast<std::size_t>(y * width + x)];
    }
    std::uint8_t& At(int x, int y) { return cells[static_cast<std::size_t>(y * width + x)]; }
    void Place(const std::uint8_t* tile, GridCell at);
    void ForgetWhere(const Plane& drift, std::uint8_t max_drift_code);

    int side;  // Of a tile.
    int width;
    int height;
    std::vector<std::uint8_t> cells;
  };

  // The cells of a tile, and those beside and below it that blocks from it reach.
  template <int kTileSide>
  struct Reach {
    static constexpr int kSide = kTileSide + kBlockSide;
    const std::uint8_t* At(int x, int y) const {
      return &cells[static_cast<std::size_t>(y * kSide + x)];
    }
    std::uint8_t* At(int x, int y) { return &cells[static_cast<std::size_t>(y * kSide + x)]; }

    std::array<std::uint8_t, std::size_t{kSide} * kSide> cells{};
  };
  using FinestReach = Reach<LikelihoodTile::kSide>;
  // Of cells two finest ones wide, which hold the maximum over 2 c .. 2 c + 2 in each axis.
  using PairReach = Reach<LikelihoodTile::kSide / kPairSide>;
  // What is known of a tile so far.
  struct Known {
    const FinestReach* finest = nullptr;
    PairReach* own_pairs = nullptr;  // Only those of the tile itself are filled in.
    const PairReach* pairs = nullptr;
  };

  const Plane& PlaneOf(int level) const { return planes_[static_cast<std::size_t>(level - 1)]; }
  void FillPlanes();
  std::size_t IndexOf(int column, int row) const {
    return static_cast<std::size_t>(row * (size_.x + 2) + column);
  }
  // Of the finest cells, from one on.
  const std::uint8_t* FinestFrom(int x, int y) {
    constexpr int kBits = LikelihoodTile::kBits;
    constexpr int kMask = LikelihoodTile::kSide - 1;
    return FinestOf(x >> kBits, y >> kBits).At(x & kMask, y & kMask);
  }
  // Of pairs by pairs of cells, from the one on that holds a finest cell.
  const std::uint8_t* PairsFrom(int x, int y) {
    constexpr int kBits = LikelihoodTile::kBits;
    constexpr int kMask = LikelihoodTile::kSide - 1;
    const PairReach*& pairs = known_[IndexOf(x >> kBits, y >> kBits)].pairs;
    if (pairs == nullptr) pairs = &MakePairs(x >> kBits, y >> kBits);
    return pairs->At((x & kMask) / kPairSide, (y & kMask) / kPairSide);
  }
  const FinestReach& FinestOf(int column, int row) {
    const FinestReach*& finest = known_[IndexOf(column, row)].finest;
    if (finest == nullptr) finest = &MakeFinest(column, row);
    return *finest;
  }
  const FinestReach& MakeFinest(int column, int row);
  // Whether nothing is stored in a tile, nor in those beside and below it.
  bool IsEmptyAround(int column, int row) const;
  const PairReach& MakePairs(int column, int row);
  PairReach& OwnPairsOf(int column, int row);
  void Copy(GridCell tile_at, GridCell to, FinestReach& reach);
  void Copy(GridCell tile_at, GridCell to, PairReach& reach);

  std::uint8_t max_drift_code_;
  GridCell first_tile_;  // Its column and row.
  GridCell size_;        // How many columns and rows of tiles there are.
  // Row by row, with two more columns and rows, into which blocks reach; null where nothing is
  // stored.
  std::vector<const LikelihoodTile*> tiles_;
  std::vector<Plane> planes_;  // By level, from 1 on.
  std::vector<Known> known_;   // By tile.
  std::deque<FinestReach> finest_;
  std::deque<PairReach> pairs_;
};

}  // namespace qwsm
