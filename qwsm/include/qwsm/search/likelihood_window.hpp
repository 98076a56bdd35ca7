// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/search/detail/search_memory.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// Cells from one to another, both included.
struct CellBox {
  GridCell low;
  GridCell high;
};

/// The part of a likelihood pyramid that one search looks at. What the search asks for is made when
/// it is first asked for, tile by tile: a search that knows early where to look pays for little
/// more.
///
/// A search moves cells by offsets. It bounds blocks of offsets at several headings at once, by the
/// greatest likelihood of the coarse cells that a beam may end in; then pairs by pairs of offsets,
/// or the offsets themselves, at one heading.
class LikelihoodWindow {
 public:
  static constexpr int kBlockSide = 4;  ///< Of a block of offsets.
  static constexpr int kBlocks = 8;     ///< So many are bounded at once, along each axis.

  /// Keeps references to tiles of the pyramid, which must not change meanwhile.
  /// @param read cells to be read, wherever they are moved to.
  /// @param max_drift_code what drifted more counts as unmapped.
  /// @param memory for what is made; it must outlive the window.
  LikelihoodWindow(const LikelihoodPyramid& pyramid,
                   const CellBox& read,
                   std::uint8_t max_drift_code,
                   SearchMemory& memory);

  /// Upper bounds of the likelihood of one cell, which is anywhere in a box, moved by any offset of
  /// each of kBlocks x kBlocks blocks.
  class Bounds {
   public:
    static constexpr int kSide = 2 * kBlocks;
    /// Of one block.
    int At(int column, int row) const { return first_[row * kSide + column]; }
    /// Of the first block; those of a row are side by side, the next row is kSide further.
    const std::uint8_t* first() const { return first_; }

   private:
    friend class LikelihoodWindow;
    const std::uint8_t* first_ = nullptr;
  };
  /// Where a box is: what is known of the tile it begins in, how large it is, and its first cell.
  struct Place {
    std::int32_t tile = 0;
    std::uint16_t shape = 0;
    std::uint16_t cell = 0;
  };
  /// Where boxes are when moved by an offset. @return valid until the next call
  std::span<const Place> PlacesOf(std::span<const CellBox> boxes, GridCell offset);
  /// The bounds of many cells, one for each box.
  /// @param areas the first block begins so many times kBlocks blocks behind the places' offset.
  /// @param bounds that are found, as many as places.
  /// @pre all boxes are in the window when moved there
  void BoundsOf(std::span<const Place> places, GridCell areas, std::span<Bounds> bounds);

  /// Row by row.
  using BlockSums = std::array<int, std::size_t{kBlocks} * kBlocks>;
  /// Sums of the bounds of many cells.
  /// @param rows so many are wanted; others may be told as 0.
  static BlockSums SumsOf(std::span<const Bounds> cells, int rows);

  /// Of how many cells SumsOfBlock() and BoundsOfPairs() ask whether to go on.
  static constexpr std::size_t kCellsAtATime = 8;
  /// What a search hopes of sums.
  struct Hope {
    int needed = 0;  ///< If none reaches it, all may be told lower than they are.
    /// What the sums of all cells after the first kCellsAtATime, twice as many .. do not exceed.
    std::span<const int> rest{};
    int rows = kBlocks;  ///< So many rows are wanted; others may be told as 0.
  };
  /// Row by row.
  using OffsetSums = std::array<int, std::size_t{kBlockSide} * kBlockSide>;
  /// Sums of the likelihoods of cells moved by each offset of a block that begins at one. Offsets
  /// may lead beyond the window; their sums say nothing.
  OffsetSums SumsOfBlock(std::span<const GridCell> cells, GridCell offset, const Hope& hope);

  /// Side of the squares of offsets that BoundsOfPairs() bounds.
  static constexpr int kPairSide = 2;
  /// Bounds of kBlocks x kBlocks pairs by pairs of offsets from one on, row by row.
  BlockSums BoundsOfPairs(std::span<const GridCell> cells, GridCell offset, const Hope& hope);
  /// Sums of the likelihoods of cells moved by one such pair by pair, row by row.
  std::array<int, 4> SumsOfPair(std::span<const GridCell> cells, GridCell offset);

 private:
  // Bytes in rows of so many.
  template <int kSideOfSquare>
  struct Square {
    static constexpr int kSide = kSideOfSquare;

    std::uint8_t* At(int x, int y) { return &cells[static_cast<std::size_t>(y * kSide + x)]; }
    const std::uint8_t* At(int x, int y) const {
      return &cells[static_cast<std::size_t>(y * kSide + x)];
    }

    std::array<std::uint8_t, std::size_t{kSide} * kSide> cells;
  };
  // The finest cells of a tile, and those beside and below it that blocks from it reach.
  using Finest = Square<LikelihoodTile::kSide + kBlockSide>;
  // Likewise of pairs by pairs of cells, the maximum over 2 c .. 2 c + 2 in each axis.
  static constexpr int kPairsOfTile = LikelihoodTile::kSide / kPairSide;
  using Pairs = Square<kPairsOfTile + kBlocks>;
  // The coarse cells of a tile that count.
  using OwnCoarse = Square<kBlocks>;
  // Those and the ones of two more tiles along each axis.
  static constexpr int kTilesOfCoarse = 3;
  using Coarse = Square<kTilesOfCoarse * kBlocks>;
  // Of each coarse cell of a tile and of the next one along each axis, the greatest of those of one
  // shape that begins there.
  using Greatest = Square<Bounds::kSide>;
  // Shapes are all oblongs up to so many coarse cells wide and high, row by row, and then squares.
  static constexpr int kOblong = 6;
  static constexpr std::array kSquares = {8, 16, 32};
  static constexpr std::size_t kShapes = kOblong * kOblong + kSquares.size();
  static constexpr std::size_t kAnyShape = kShapes;  // What is larger than these.
  // What is made where none counts: one of each for all tiles.
  static const OwnCoarse kNoOwnCoarse;
  static const Coarse kNoCoarse;
  static const Greatest kNoGreatest;
  // What is known of the coarse cells about a tile so far.
  struct Known {
    const Coarse* coarse = nullptr;
    std::array<const Greatest*, kShapes + 1> greatest{};  // By shape.
  };
  using CellsAtATime = std::array<const std::uint8_t*, kCellsAtATime>;

  std::size_t IndexOf(int column, int row) const {
    return static_cast<std::size_t>(row * size_.x + column);
  }
  bool HasTile(int column, int row) const { return column < size_.x && row < size_.y; }
  // Null where nothing is stored.
  const LikelihoodTile* TileAt(int column, int row) const {
    return HasTile(column, row) ? tiles_[IndexOf(column, row)] : nullptr;
  }
  // Tells where cells are, moved by an offset, in the squares of their tiles.
  // @param make makes those that are not there yet.
  template <int kCellSide, class SquareOfTile, class Make>
  void Find(std::span<const SquareOfTile*> square_of,
            std::span<const GridCell> cells,
            GridCell offset,
            CellsAtATime& found,
            const Make& make);
  void FindFinest(std::span<const GridCell> cells, GridCell offset, CellsAtATime& finest);
  const Finest& MakeFinest(int column, int row);
  void CopyFinest(GridCell tile_at, GridCell to, Finest& finest);
  void FindPairs(std::span<const GridCell> cells, GridCell offset, CellsAtATime& pairs);
  const Pairs& MakePairs(int column, int row);
  void CopyPairs(GridCell tile_at, GridCell to, Pairs& pairs);
  Pairs& OwnPairsOf(int column, int row);
  static std::uint16_t ShapeOf(int width, int height);
  const Greatest& GreatestOf(int column, int row, std::size_t shape);
  const Greatest& MakeGreatest(int column, int row, std::size_t shape);
  const Greatest& JoinGreatest(int column, int row, std::size_t shape);
  static void RaiseTo(const Greatest& a, const Greatest& b, Greatest& greater);
  const Coarse& CoarseOf(int column, int row);
  const std::uint8_t* OwnCoarseOf(int column, int row);
  static void CopyCoarse(const std::uint8_t* own, std::uint8_t* to);
  const OwnCoarse& MakeOwnCoarse(const LikelihoodTile& tile);

  SearchMemory& memory_;
  std::vector<Place> places_;
  std::uint8_t max_drift_code_;
  GridCell first_;  // Cell that the first tile begins with.
  GridCell size_;   // How many columns and rows of tiles there are.
  // Of each tile, row by row; null where nothing is stored or nothing is known yet.
  std::vector<const LikelihoodTile*> tiles_;
  std::span<Known*> known_of_;
  std::span<const OwnCoarse*> own_coarse_of_;  // Empty where all that is stored counts.
  std::span<const Finest*> finest_of_;
  std::span<Pairs*> own_pairs_of_;  // Only those of the tile itself are filled in.
  std::span<const Pairs*> pairs_of_;
};

}  // namespace qwsm
