// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr int kSide = LikelihoodWindow::kBlockSide;

// Every processor of the last twenty years adds eight sums at once.
using RowOfSums = std::uint16_t __attribute__((vector_size(2 * kSide)));

// Eight bytes as numbers of 16 bits: interleaved with zeros.
RowOfSums Widened(const std::uint8_t* row) {
  using Bytes = std::uint8_t __attribute__((vector_size(2 * kSide)));
  using Words = std::uint64_t __attribute__((vector_size(2 * kSide)));
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, row, sizeof(bytes));
  const auto low = std::bit_cast<Bytes>(Words{bytes, 0});
  return std::bit_cast<RowOfSums>(__builtin_shufflevector(
      low, Bytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}

using SixteenBytes = std::uint8_t __attribute__((vector_size(16)));

// Of each of sixteen cells from one on, the maximum over it, the two beside it, and those below.
SixteenBytes MaximumOfThreeByThree(const std::uint8_t* cell, int stride) {
  SixteenBytes maximum{};
  for (int y = 0; y < 3; ++y, cell += stride) {
    for (int x = 0; x < 3; ++x) {
      SixteenBytes moved;
      std::memcpy(&moved, cell + x, sizeof(moved));
      maximum = maximum < moved ? moved : maximum;
    }
  }
  return maximum;
}

struct TileRow {
  SixteenBytes left;
  SixteenBytes right;
};
static_assert(sizeof(TileRow) == Tile::kSide);

// A row of a tile's finest cells, 0 where all has drifted too much.
TileRow WithoutDrifted(const Tile& tile, int y, std::uint8_t max_drift_code) {
  static_assert(Tile::DriftShiftOf(0) == 1);
  SixteenBytes drift;
  std::memcpy(&drift, tile.drift_codes(0) + (y / 2) * (Tile::kSide / 2), sizeof(drift));
  const auto kept = std::bit_cast<SixteenBytes>(drift <= max_drift_code);
  TileRow row;
  std::memcpy(&row, tile.likelihoods(0) + y * Tile::kSide, sizeof(row));
  row.left &= __builtin_shufflevector(kept, kept, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
  row.right &= __builtin_shufflevector(
      kept, kept, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13, 14, 14, 15, 15);
  return row;
}

// The sums of up to kMostSummands blocks of bytes, of so many rows each: no more fit 16 bits.
template <int kRows = kSide>
class ShortSums {
 public:
  static constexpr std::size_t kMostSummands = 256;

  // Adds a block of which the first row is at `row`.
  void Add(const std::uint8_t* row, int stride) {
    for (RowOfSums& sums : rows_) {
      sums += Widened(row);
      row += stride;
    }
  }

  // None is larger.
  int Largest() const {
    RowOfSums largest = rows_.front();
    for (const RowOfSums& sums : rows_) largest = largest < sums ? sums : largest;
    int value = 0;
    for (int column = 0; column < kSide; ++column) value = std::max<int>(value, largest[column]);
    return value;
  }

  void AddTo(LikelihoodWindow::BlockSums& sums) const {
    auto sum = sums.begin();
    for (const RowOfSums& row : rows_) {
      for (int column = 0; column < kSide; ++column) *sum++ += row[column];
    }
  }

 private:
  std::array<RowOfSums, kRows> rows_{};
};

// Sums what `add` adds for each cell, while some sum can still be what is hoped.
// @param bound_of of some cells, what none of their sums exceeds.
template <int kRows = kSide, class Add, class BoundOf>
LikelihoodWindow::BlockSums SumWhileHopeful(std::span<const GridCell> cells,
                                            const LikelihoodWindow::Hope& hope,
                                            Add add,
                                            BoundOf bound_of) {
  constexpr std::size_t kAtATime = 32;  // Cells after which to ask whether to go on.
  static_assert(ShortSums<>::kMostSummands % kAtATime == 0);
  int rest = hope.bound;  // Of the cells that are not summed yet.
  int largest = 0;        // Of the sums.
  LikelihoodWindow::BlockSums sums{};
  while (!cells.empty()) {
    ShortSums<kRows> of_next;
    for (std::size_t summands = 0; summands < ShortSums<>::kMostSummands && !cells.empty();) {
      const auto next = cells.first(std::min(cells.size(), kAtATime));
      cells = cells.subspan(next.size());
      summands += next.size();
      for (const GridCell& cell : next) add(cell, of_next);
      if (hope.needed <= 0 || cells.empty()) continue;
      rest -= bound_of(next);
      if (largest + of_next.Largest() + rest < hope.needed) return sums;
    }
    of_next.AddTo(sums);
    largest = *std::ranges::max_element(sums);
  }
  return sums;
}

}  // namespace

LikelihoodWindow::LikelihoodWindow(const LikelihoodPyramid& pyramid,
                                   GridCell low,
                                   GridCell high,
                                   std::uint8_t max_drift_code)
    : max_drift_code_(max_drift_code),
      first_tile_{low.x >> Tile::kBits, low.y >> Tile::kBits},
      size_{(high.x >> Tile::kBits) - first_tile_.x + 1,
            (high.y >> Tile::kBits) - first_tile_.y + 1},
      tiles_(pyramid.FindTiles(first_tile_, {size_.x + 2, size_.y + 2})),
      known_(tiles_.size()) {
  FillPlanes();
}

LikelihoodWindow::BlockSums LikelihoodWindow::BoundsOfBlocks(int level,
                                                             std::span<const GridCell> cells,
                                                             GridCell offset) const {
  const Plane& plane = PlaneOf(level);
  const int shift = Tile::ShiftOf(level);
  const int x = offset.x - first_tile_.x * Tile::kSide;
  const int y = offset.y - first_tile_.y * Tile::kSide;
  return SumWhileHopeful(
      cells,
      {},
      [&](const GridCell& cell, ShortSums<>& sums) {
        sums.Add(&plane.At((cell.x + x) >> shift, (cell.y + y) >> shift), plane.width);
      },
      [](std::span<const GridCell>) { return 0; });
}

LikelihoodWindow::BlockSums LikelihoodWindow::SumsOfBlock(std::span<const GridCell> cells,
                                                          GridCell offset,
                                                          const Hope& hope) {
  const int x = offset.x - first_tile_.x * Tile::kSide;
  const int y = offset.y - first_tile_.y * Tile::kSide;
  const auto add = [&](const GridCell& cell, auto& sums) {
    sums.Add(FinestFrom(cell.x + x, cell.y + y), FinestReach::kSide);
  };
  const auto bound_of = [&](std::span<const GridCell> some) {
    return Bound(kBlockLevel, some, offset);
  };
  return hope.rows > kSide / 2 ? SumWhileHopeful(cells, hope, add, bound_of)
                               : SumWhileHopeful<kSide / 2>(cells, hope, add, bound_of);
}

LikelihoodWindow::BlockSums LikelihoodWindow::BoundsOfPairs(std::span<const GridCell> cells,
                                                            GridCell offset,
                                                            const Hope& hope) {
  constexpr int kCoarsest = Tile::kLevels - 1;
  static_assert(kPairSide * kBlockSide == 1 << Tile::ShiftOf(kCoarsest));
  const int x = offset.x - first_tile_.x * Tile::kSide;
  const int y = offset.y - first_tile_.y * Tile::kSide;
  return SumWhileHopeful(
      cells,
      hope,
      [&](const GridCell& cell, ShortSums<>& sums) {
        sums.Add(PairsFrom(cell.x + x, cell.y + y), PairReach::kSide);
      },
      [&](std::span<const GridCell> some) { return Bound(kCoarsest, some, offset); });
}

std::array<int, 4> LikelihoodWindow::SumsOfPair(std::span<const GridCell> cells, GridCell offset) {
  const int x = offset.x - first_tile_.x * Tile::kSide;
  const int y = offset.y - first_tile_.y * Tile::kSide;
  std::array<int, 4> sums{};
  for (const GridCell& cell : cells) {
    const std::uint8_t* above = FinestFrom(cell.x + x, cell.y + y);
    const std::uint8_t* below = above + FinestReach::kSide;
    sums[0] += above[0];
    sums[1] += above[1];
    sums[2] += below[0];
    sums[3] += below[1];
  }
  return sums;
}

void LikelihoodWindow::FillPlanes() {
  const bool forgets = max_drift_code_ != LikelihoodPyramid::kUnmapped;
  for (int level = 1; level < Tile::kLevels; ++level) {
    const int side = Tile::kSide >> Tile::ShiftOf(level);
    Plane& plane = planes_.emplace_back(side, size_, std::uint8_t{0});
    Plane drift(side, forgets ? size_ : GridCell{}, LikelihoodPyramid::kUnmapped);
    for (int row = 0; row < size_.y; ++row) {
      auto tile = tiles_.begin() + row * (size_.x + 2);
      for (int column = 0; column < size_.x; ++column, ++tile) {
        if (*tile == nullptr) continue;
        plane.Place((*tile)->likelihoods(level), {column, row});
        if (forgets) drift.Place((*tile)->drift_codes(level), {column, row});
      }
    }
    if (forgets) plane.ForgetWhere(drift, max_drift_code_);
  }
}

// Puts the rows of a tile in their place.
void LikelihoodWindow::Plane::Place(const std::uint8_t* tile, GridCell at) {
  for (int y = 0; y < side; ++y) {
    std::copy_n(tile + y * side, side, &At(at.x * side, at.y * side + y));
  }
}

// Sets the likelihood of cells to 0 that no surface with little drift is in. A coarse cell is the
// maximum over itself and most of the next one along each axis.
void LikelihoodWindow::Plane::ForgetWhere(const Plane& drift, std::uint8_t max_drift_code) {
  static_assert(Tile::DriftShiftOf(1) == Tile::ShiftOf(1));
  static_assert(Tile::DriftShiftOf(2) == Tile::ShiftOf(2));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* of_row = &drift.At(0, y);
    const std::uint8_t* of_next = &drift.At(0, y + 1);
    std::uint8_t* likelihood = &At(0, y);
    for (int x = 0; x < width - kBlockSide; ++x) {
      const std::uint8_t smallest = std::min(std::min(of_row[x], of_row[x + 1]),  //
                                             std::min(of_next[x], of_next[x + 1]));
      likelihood[x] = smallest > max_drift_code ? std::uint8_t{0} : likelihood[x];
    }
  }
}

// The finest cells of a tile and what is beside and below it.
const LikelihoodWindow::FinestReach& LikelihoodWindow::MakeFinest(int column, int row) {
  static const FinestReach kNothing;
  if (IsEmptyAround(column, row)) return kNothing;
  FinestReach& reach = finest_.emplace_back();
  for (const int below : {0, 1}) {
    for (const int right : {0, 1}) {
      const GridCell tile_at{column + right, row + below};
      Copy(tile_at, {right * Tile::kSide, below * Tile::kSide}, reach);
    }
  }
  return reach;
}

bool LikelihoodWindow::IsEmptyAround(int column, int row) const {
  const int last_column = std::min(column + 1, size_.x + 1);
  const int last_row = std::min(row + 1, size_.y + 1);
  for (int y = row; y <= last_row; ++y) {
    for (int x = column; x <= last_column; ++x) {
      if (tiles_[IndexOf(x, y)] != nullptr) return false;
    }
  }
  return true;
}

// Copies as many of a tile's finest cells as fit.
void LikelihoodWindow::Copy(GridCell tile_at, GridCell to, FinestReach& reach) {
  if (tile_at.x >= size_.x + 2 || tile_at.y >= size_.y + 2) return;
  const Tile* tile = tiles_[IndexOf(tile_at.x, tile_at.y)];
  if (tile == nullptr) return;
  const int rows = std::min(Tile::kSide, FinestReach::kSide - to.y);
  for (int y = 0; y < rows; ++y) {
    const TileRow row = WithoutDrifted(*tile, y, max_drift_code_);
    to.x == 0 ? std::memcpy(reach.At(0, to.y + y), &row, sizeof(row))
              : std::memcpy(reach.At(to.x, to.y + y), &row, kSide);
  }
}

// The pairs by pairs of cells of a tile and what is beside and below it.
const LikelihoodWindow::PairReach& LikelihoodWindow::MakePairs(int column, int row) {
  constexpr int kPairs = Tile::kSide / kPairSide;
  PairReach& reach = OwnPairsOf(column, row);
  Copy({column + 1, row}, {kPairs, 0}, reach);
  Copy({column, row + 1}, {0, kPairs}, reach);
  Copy({column + 1, row + 1}, {kPairs, kPairs}, reach);
  return reach;
}

void LikelihoodWindow::Copy(GridCell tile_at, GridCell to, PairReach& reach) {
  constexpr int kPairs = Tile::kSide / kPairSide;
  const PairReach& from = OwnPairsOf(tile_at.x, tile_at.y);
  const int rows = std::min(kPairs, PairReach::kSide - to.y);
  for (int y = 0; y < rows; ++y) {
    to.x == 0 ? std::memcpy(reach.At(0, to.y + y), from.At(0, y), kPairs)
              : std::memcpy(reach.At(to.x, to.y + y), from.At(0, y), kSide);
  }
}

// Those of the tile itself: the maximum of three cells along each axis.
LikelihoodWindow::PairReach& LikelihoodWindow::OwnPairsOf(int column, int row) {
  PairReach*& own = known_[IndexOf(column, row)].own_pairs;
  if (own != nullptr) return *own;
  const FinestReach& finest = FinestOf(column, row);
  own = &pairs_.emplace_back();
  for (int y = 0; y < Tile::kSide; y += kPairSide) {
    const SixteenBytes left = MaximumOfThreeByThree(finest.At(0, y), FinestReach::kSide);
    const SixteenBytes right = MaximumOfThreeByThree(finest.At(16, y), FinestReach::kSide);
    const SixteenBytes every_other = __builtin_shufflevector(
        left, right, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    std::memcpy(own->At(0, y / kPairSide), &every_other, sizeof(every_other));
  }
  return *own;
}

}  // namespace qwsm
