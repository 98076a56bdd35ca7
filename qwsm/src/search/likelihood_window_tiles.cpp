// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What a window makes of tiles when it is first asked for it.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "qwsm/search/likelihood_window.hpp"
#include "short_sums.hpp"

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr int kCoarseSide = LikelihoodWindow::kBlocks;  // Of a tile, in coarse cells.

struct TileRow {
  SixteenBytes left;
  SixteenBytes right;
};
static_assert(sizeof(TileRow) == Tile::kSide);

// A row of a tile's finest cells.
TileRow RowOf(const Tile& tile, int y) {
  TileRow row;
  std::memcpy(&row, tile.likelihoods(0) + y * Tile::kSide, sizeof(row));
  return row;
}

// The same, 0 where all has drifted too much.
TileRow WithoutDrifted(const Tile& tile, int y, std::uint8_t max_drift_code) {
  static_assert(Tile::DriftShiftOf(0) == 1);
  const SixteenBytes drift = LoadSixteen(tile.drift_codes(0) + (y / 2) * (Tile::kSide / 2));
  const auto kept = std::bit_cast<SixteenBytes>(drift <= max_drift_code);
  TileRow row = RowOf(tile, y);
  row.left &= __builtin_shufflevector(kept, kept, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7);
  row.right &= __builtin_shufflevector(
      kept, kept, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13, 14, 14, 15, 15);
  return row;
}

// Of the coarse cells of a row of a tile, 255 for those in which something drifted little enough.
std::uint64_t KeptOfRow(const Tile& tile, int row, std::uint8_t max_drift_code) {
  static_assert(Tile::ShiftOf(1) == Tile::DriftShiftOf(0) + 1);
  constexpr int kCodes = Tile::kSide >> Tile::DriftShiftOf(0);  // In a row.
  const std::uint8_t* above = tile.drift_codes(0) + 2 * row * kCodes;
  const std::uint8_t* below = above + kCodes;
  const auto kept = std::bit_cast<SixteenBytes>((LoadSixteen(above) <= max_drift_code) |
                                                (LoadSixteen(below) <= max_drift_code));
  using EightBytes = std::uint8_t __attribute__((vector_size(8)));
  const auto pairs = std::bit_cast<EightSums>(kept);
  return std::bit_cast<std::uint64_t>(__builtin_convertvector(pairs | (pairs >> 8), EightBytes));
}

// Of each of sixteen cells from one on, the maximum over it, the two beside it, and those below.
SixteenBytes MaximumOfThreeByThree(const std::uint8_t* cell, int stride) {
  SixteenBytes maximum{};
  for (int y = 0; y < 3; ++y, cell += stride) {
    for (int x = 0; x < 3; ++x) maximum = GreaterOf(maximum, LoadSixteen(cell + x));
  }
  return maximum;
}

// Of each of sixteen by sixteen cells, the greatest of those of an oblong that begins there.
template <int kWidth, int kHeight, int kStride>
void FindGreatest(const std::uint8_t* cells, std::uint8_t* greatest) {
  constexpr int kCount = 16;
  std::array<SixteenBytes, kCount + kHeight - 1> of_rows;
  for (SixteenBytes& of_row : of_rows) {
    of_row = LoadSixteen(cells);
    for (int x = 1; x < kWidth; ++x) of_row = GreaterOf(of_row, LoadSixteen(cells + x));
    cells += kStride;
  }
  for (std::size_t row = 0; row < kCount; ++row, greatest += kCount) {
    SixteenBytes of_oblong = of_rows[row];
    for (std::size_t y = 1; y < kHeight; ++y) of_oblong = GreaterOf(of_oblong, of_rows[row + y]);
    std::memcpy(greatest, &of_oblong, sizeof(of_oblong));
  }
}

}  // namespace

constinit const LikelihoodWindow::OwnCoarse LikelihoodWindow::kNoOwnCoarse{};
constinit const LikelihoodWindow::Coarse LikelihoodWindow::kNoCoarse{};
constinit const LikelihoodWindow::Greatest LikelihoodWindow::kNoGreatest{};

// The finest cells of a tile and what is beside and below it.
const LikelihoodWindow::Finest& LikelihoodWindow::MakeFinest(int column, int row) {
  static constexpr Finest kNothing{};
  bool is_empty = true;
  for (const int below : {0, 1}) {
    for (const int right : {0, 1}) is_empty &= TileAt(column + right, row + below) == nullptr;
  }
  if (is_empty) return *(finest_of_[IndexOf(column, row)] = &kNothing);
  Finest& finest = memory_.Take<Finest>(1).front();
  finest_of_[IndexOf(column, row)] = &finest;
  finest.cells.fill(0);
  for (const int below : {0, 1}) {
    for (const int right : {0, 1}) {
      const GridCell tile_at{column + right, row + below};
      CopyFinest(tile_at, {right * Tile::kSide, below * Tile::kSide}, finest);
    }
  }
  return finest;
}

// Copies as many of a tile's finest cells as fit.
void LikelihoodWindow::CopyFinest(GridCell tile_at, GridCell to, Finest& finest) {
  const Tile* tile = TileAt(tile_at.x, tile_at.y);
  if (tile == nullptr) return;
  const bool forgets = max_drift_code_ != Tile::kUnmapped;
  const int rows = std::min(Tile::kSide, Finest::kSide - to.y);
  std::uint8_t* cells = finest.At(to.x, to.y);
  for (int y = 0; y < rows; ++y, cells += Finest::kSide) {
    const TileRow row = forgets ? WithoutDrifted(*tile, y, max_drift_code_) : RowOf(*tile, y);
    to.x == 0 ? std::memcpy(cells, &row, sizeof(row)) : std::memcpy(cells, &row, kBlockSide);
  }
}

// The pairs by pairs of cells of a tile and what is beside and below it.
const LikelihoodWindow::Pairs& LikelihoodWindow::MakePairs(int column, int row) {
  Pairs& pairs = OwnPairsOf(column, row);
  CopyPairs({column + 1, row}, {kPairsOfTile, 0}, pairs);
  CopyPairs({column, row + 1}, {0, kPairsOfTile}, pairs);
  CopyPairs({column + 1, row + 1}, {kPairsOfTile, kPairsOfTile}, pairs);
  pairs_of_[IndexOf(column, row)] = &pairs;
  return pairs;
}

// Copies as many of the pairs of a tile as fit.
void LikelihoodWindow::CopyPairs(GridCell tile_at, GridCell to, Pairs& pairs) {
  static constexpr Pairs kNothing{};
  const int rows = std::min(kPairsOfTile, Pairs::kSide - to.y);
  const int columns = std::min(kPairsOfTile, Pairs::kSide - to.x);
  const Pairs& from = HasTile(tile_at.x, tile_at.y) ? OwnPairsOf(tile_at.x, tile_at.y) : kNothing;
  for (int y = 0; y < rows; ++y) {
    std::uint8_t* row = pairs.At(to.x, to.y + y);
    columns == kPairsOfTile ? std::memcpy(row, from.At(0, y), kPairsOfTile)
                            : std::memcpy(row, from.At(0, y), kBlocks);
  }
}

// Those of the tile itself: the maximum of three cells along each axis.
LikelihoodWindow::Pairs& LikelihoodWindow::OwnPairsOf(int column, int row) {
  Pairs*& own = own_pairs_of_[IndexOf(column, row)];
  if (own != nullptr) return *own;
  const Finest* known = finest_of_[IndexOf(column, row)];
  const Finest& finest = known == nullptr ? MakeFinest(column, row) : *known;
  own = &memory_.Take<Pairs>(1).front();
  const std::uint8_t* cells = finest.cells.data();
  for (int y = 0; y < kPairsOfTile; ++y, cells += kPairSide * Finest::kSide) {
    const SixteenBytes left = MaximumOfThreeByThree(cells, Finest::kSide);
    const SixteenBytes right = MaximumOfThreeByThree(cells + 16, Finest::kSide);
    const SixteenBytes every_other = __builtin_shufflevector(
        left, right, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    std::memcpy(own->At(0, y), &every_other, sizeof(every_other));
  }
  return *own;
}

// The greatest likelihoods about a tile that may lie beyond the window.
const LikelihoodWindow::Greatest& LikelihoodWindow::GreatestOf(int column,
                                                               int row,
                                                               std::size_t shape) {
  static constexpr Greatest kAnything = [] {
    Greatest anything{};
    anything.cells.fill(255);
    return anything;
  }();
  if (shape == kAnyShape) return kAnything;
  if (!HasTile(column, row)) return kNoGreatest;
  Known*& known = known_of_[IndexOf(column, row)];
  if (known == nullptr) known = &memory_.TakeZeros<Known>(1).front();
  const Greatest*& greatest = known->greatest[shape];
  if (greatest == nullptr) greatest = &MakeGreatest(column, row, shape);
  return *greatest;
}

const LikelihoodWindow::Greatest& LikelihoodWindow::MakeGreatest(int column,
                                                                 int row,
                                                                 std::size_t shape) {
  static constexpr auto kFindOblong = []<std::size_t... kShape>(std::index_sequence<kShape...>) {
    return std::array{
        &FindGreatest<int{kShape % kOblong} + 1, int{kShape / kOblong} + 1, Coarse::kSide>...};
  }
  (std::make_index_sequence<std::size_t{kOblong * kOblong}>{});
  constexpr std::size_t kFirstSquare = kFindOblong.size();
  static_assert(kSquares.front() == kCoarseSide);
  if (shape > kFirstSquare) return JoinGreatest(column, row, shape);
  const Coarse& coarse = CoarseOf(column, row);
  if (&coarse == &kNoCoarse) return kNoGreatest;
  Greatest& greatest = memory_.Take<Greatest>(1).front();
  const auto find = shape < kFirstSquare ? kFindOblong[shape]
                                         : &FindGreatest<kCoarseSide, kCoarseSide, Coarse::kSide>;
  find(coarse.cells.data(), greatest.cells.data());
  return greatest;
}

// A square as long as two tiles or more: of four squares of half the side.
const LikelihoodWindow::Greatest& LikelihoodWindow::JoinGreatest(int column,
                                                                 int row,
                                                                 std::size_t shape) {
  const int apart = kSquares[shape - kOblong * kOblong] / 2 / kCoarseSide;  // In tiles.
  const Greatest* joined = &kNoGreatest;
  Greatest* own = nullptr;
  for (const int below : {0, apart}) {
    for (const int right : {0, apart}) {
      const Greatest& quarter = GreatestOf(column + right, row + below, shape - 1);
      if (&quarter == &kNoGreatest) continue;
      if (joined == &kNoGreatest) {
        joined = &quarter;
        continue;
      }
      if (own == nullptr) own = &memory_.Take<Greatest>(1).front();
      RaiseTo(*joined, quarter, *own);
      joined = own;
    }
  }
  return *joined;
}

// The greater of each two.
void LikelihoodWindow::RaiseTo(const Greatest& a, const Greatest& b, Greatest& greater) {
  for (int y = 0; y < Greatest::kSide; ++y) {
    const SixteenBytes row = GreaterOf(LoadSixteen(a.At(0, y)), LoadSixteen(b.At(0, y)));
    std::memcpy(greater.At(0, y), &row, sizeof(row));
  }
}

// The coarse cells of a tile and of those beside and below it. Where none counts, as in much of what
// is outdoors, nothing is made of them.
const LikelihoodWindow::Coarse& LikelihoodWindow::CoarseOf(int column, int row) {
  const Coarse*& known = known_of_[IndexOf(column, row)]->coarse;
  if (known != nullptr) return *known;
  std::array<const std::uint8_t*, std::size_t{kTilesOfCoarse} * kTilesOfCoarse> own;
  auto next = own.begin();
  for (int y = 0; y < kTilesOfCoarse; ++y) {
    for (int x = 0; x < kTilesOfCoarse; ++x) *next++ = OwnCoarseOf(column + x, row + y);
  }
  const auto is_empty = [](const std::uint8_t* cells) { return cells == kNoOwnCoarse.At(0, 0); };
  if (std::ranges::all_of(own, is_empty)) return *(known = &kNoCoarse);
  Coarse& coarse = memory_.Take<Coarse>(1).front();
  known = &coarse;
  next = own.begin();
  for (int y = 0; y < kTilesOfCoarse; ++y) {
    for (int x = 0; x < kTilesOfCoarse; ++x) {
      CopyCoarse(*next++, coarse.At(x * kCoarseSide, y * kCoarseSide));
    }
  }
  return coarse;
}

// @param own coarse cells of one tile, row by row.
void LikelihoodWindow::CopyCoarse(const std::uint8_t* own, std::uint8_t* to) {
  for (int y = 0; y < kCoarseSide; ++y, own += kCoarseSide, to += Coarse::kSide) {
    std::memcpy(to, own, kCoarseSide);
  }
}

// Those of the tile itself, row by row; of kNoOwnCoarse where none counts.
const std::uint8_t* LikelihoodWindow::OwnCoarseOf(int column, int row) {
  const Tile* tile = TileAt(column, row);
  if (tile == nullptr) return kNoOwnCoarse.At(0, 0);
  if (max_drift_code_ == Tile::kUnmapped) return tile->likelihoods(1);
  const OwnCoarse*& known = own_coarse_of_[IndexOf(column, row)];
  if (known == nullptr) known = &MakeOwnCoarse(*tile);
  return known->At(0, 0);
}

// Those in which something has drifted little enough.
const LikelihoodWindow::OwnCoarse& LikelihoodWindow::MakeOwnCoarse(const Tile& tile) {
  OwnCoarse own;
  std::uint64_t any = 0;
  for (int row = 0; row < kCoarseSide; ++row) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, tile.likelihoods(1) + row * kCoarseSide, sizeof(eight));
    eight &= KeptOfRow(tile, row, max_drift_code_);
    std::memcpy(own.At(0, row), &eight, sizeof(eight));
    any |= eight;
  }
  return any == 0 ? kNoOwnCoarse : memory_.Take<OwnCoarse>(1).front() = own;
}

}  // namespace qwsm
