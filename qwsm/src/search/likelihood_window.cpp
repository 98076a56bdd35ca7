// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "short_sums.hpp"

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr int kCoarseShift = Tile::ShiftOf(1);
static_assert(LikelihoodWindow::kBlockSide == 1 << kCoarseShift);
static_assert(LikelihoodWindow::kBlocks == Tile::kSide >> kCoarseShift);

template <int kRows>
LikelihoodWindow::BlockSums SumRows(std::span<const LikelihoodWindow::Bounds> cells) {
  LikelihoodWindow::BlockSums sums{};
  while (!cells.empty()) {
    const auto next = cells.first(std::min(cells.size(), kMostSummands));
    cells = cells.subspan(next.size());
    SumsOfRows<kRows, LikelihoodWindow::Bounds::kSide> of_next;
    for (const LikelihoodWindow::Bounds& cell : next) of_next.Add(cell.first());
    of_next.AddTo(sums);
  }
  return sums;
}

// Sums what is found of cells, while some sum can still be what is hoped.
// @param find tells where the rows of some cells begin.
template <class ShortSums, class Find>
typename ShortSums::Sums SumWhileHopeful(std::span<const GridCell> cells,
                                         const LikelihoodWindow::Hope& hope,
                                         Find find) {
  constexpr std::size_t kAtATime = LikelihoodWindow::kCellsAtATime;
  static_assert(kMostSummands % kAtATime == 0);
  std::array<const std::uint8_t*, kAtATime> found;
  auto rest = hope.rest.begin();
  int largest = 0;  // Of the sums.
  typename ShortSums::Sums sums{};
  while (!cells.empty()) {
    ShortSums of_next;
    for (std::size_t summands = 0; summands < kMostSummands && !cells.empty();) {
      const auto next = cells.first(std::min(cells.size(), kAtATime));
      cells = cells.subspan(next.size());
      summands += next.size();
      find(next, found);
      for (std::size_t i = 0; i < next.size(); ++i) of_next.Add(found[i]);
      if (hope.needed <= 0 || cells.empty()) continue;
      const int missing = hope.needed - largest - *rest++;
      if (missing > kLargestShortSum) return sums;
      if (missing > 0 && !of_next.AnyReaches(static_cast<std::uint16_t>(missing))) return sums;
    }
    of_next.AddTo(sums);
    if (!cells.empty()) largest = *std::ranges::max_element(sums);
  }
  return sums;
}

}  // namespace

LikelihoodWindow::LikelihoodWindow(const LikelihoodPyramid& pyramid,
                                   const CellBox& read,
                                   std::uint8_t max_drift_code,
                                   SearchMemory& memory)
    : memory_(memory), max_drift_code_(max_drift_code) {
  const GridCell first{read.low.x >> Tile::kBits, read.low.y >> Tile::kBits};
  first_ = {first.x * Tile::kSide, first.y * Tile::kSide};
  size_ = {(read.high.x >> Tile::kBits) - first.x + 1, (read.high.y >> Tile::kBits) - first.y + 1};
  tiles_ = pyramid.FindTiles(first, size_);
  known_of_ = memory.TakeZeros<Known*>(tiles_.size());
  if (max_drift_code != Tile::kUnmapped) {
    own_coarse_of_ = memory.TakeZeros<const OwnCoarse*>(tiles_.size());
  }
  finest_of_ = memory.TakeZeros<const Finest*>(tiles_.size());
  own_pairs_of_ = memory.TakeZeros<Pairs*>(tiles_.size());
  pairs_of_ = memory.TakeZeros<const Pairs*>(tiles_.size());
}

std::span<const LikelihoodWindow::Place> LikelihoodWindow::PlacesOf(std::span<const CellBox> boxes,
                                                                    GridCell offset) {
  using FourCells = std::int32_t __attribute__((vector_size(16)));
  static_assert(sizeof(CellBox) == sizeof(FourCells));
  constexpr int kTileShift = Tile::kBits - kCoarseShift;
  constexpr int kMask = kBlocks - 1;
  constexpr int kLast = kBlockSide - 1;  // Offset of a block.
  const GridCell to{offset.x - first_.x, offset.y - first_.y};
  const FourCells move{to.x, to.y, to.x + kLast, to.y + kLast};
  places_.resize(boxes.size());
  const int columns = size_.x;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const FourCells coarse = (std::bit_cast<FourCells>(boxes[i]) + move) >> kCoarseShift;
    const GridCell low{coarse[0], coarse[1]};
    const int cell = (low.y & kMask) * Bounds::kSide + (low.x & kMask);
    places_[i] = {.tile = (low.y >> kTileShift) * columns + (low.x >> kTileShift),
                  .shape = ShapeOf(coarse[2] - low.x + 1, coarse[3] - low.y + 1),
                  .cell = static_cast<std::uint16_t>(cell)};
  }
  return places_;
}

void LikelihoodWindow::BoundsOf(std::span<const Place> places,
                                GridCell areas,
                                std::span<Bounds> bounds) {
  static_assert(kBlocks * kBlockSide == Tile::kSide);
  const int further = areas.y * size_.x + areas.x;  // By an area, a box moves to the next tile.
  Known* const* known_of = known_of_.data() + further;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [tile, shape, cell] = places[i];
    const Known* known = known_of[tile];
    const Greatest* greatest = known == nullptr ? nullptr : known->greatest[shape];
    if (greatest == nullptr) {
      const int index = tile + further;
      greatest = &GreatestOf(index % size_.x, index / size_.x, shape);
    }
    bounds[i].first_ = greatest->cells.data() + cell;
  }
}

// The smallest shape that holds so many coarse cells.
std::uint16_t LikelihoodWindow::ShapeOf(int width, int height) {
  if (std::max(width, height) <= kOblong) {
    return static_cast<std::uint16_t>((height - 1) * kOblong + width - 1);
  }
  std::uint16_t shape = kOblong * kOblong;
  for (const int side : kSquares) {
    if (std::max(width, height) <= side) break;
    ++shape;
  }
  return shape;
}

LikelihoodWindow::BlockSums LikelihoodWindow::SumsOf(std::span<const Bounds> cells, int rows) {
  if (rows <= 2) return SumRows<2>(cells);
  if (rows <= 5) return SumRows<5>(cells);
  return SumRows<kBlocks>(cells);
}

LikelihoodWindow::OffsetSums LikelihoodWindow::SumsOfBlock(std::span<const GridCell> cells,
                                                           GridCell offset,
                                                           const Hope& hope) {
  return SumWhileHopeful<SumsOfSquares<Finest::kSide>>(
      cells, hope, [this, offset](std::span<const GridCell> some, CellsAtATime& finest) {
        FindFinest(some, offset, finest);
      });
}

LikelihoodWindow::BlockSums LikelihoodWindow::BoundsOfPairs(std::span<const GridCell> cells,
                                                            GridCell offset,
                                                            const Hope& hope) {
  const auto find = [this, offset](std::span<const GridCell> some, CellsAtATime& pairs) {
    FindPairs(some, offset, pairs);
  };
  return hope.rows > kBlocks / 2
             ? SumWhileHopeful<SumsOfRows<kBlocks, Pairs::kSide>>(cells, hope, find)
             : SumWhileHopeful<SumsOfRows<kBlocks / 2, Pairs::kSide>>(cells, hope, find);
}

std::array<int, 4> LikelihoodWindow::SumsOfPair(std::span<const GridCell> cells, GridCell offset) {
  std::array<int, 4> sums{};
  CellsAtATime finest;
  while (!cells.empty()) {
    const auto next = cells.first(std::min(cells.size(), kCellsAtATime));
    cells = cells.subspan(next.size());
    FindFinest(next, offset, finest);
    for (std::size_t i = 0; i < next.size(); ++i) {
      const std::uint8_t* above = finest[i];
      const std::uint8_t* below = above + Finest::kSide;
      sums[0] += above[0];
      sums[1] += above[1];
      sums[2] += below[0];
      sums[3] += below[1];
    }
  }
  return sums;
}

void LikelihoodWindow::FindFinest(std::span<const GridCell> cells,
                                  GridCell offset,
                                  CellsAtATime& finest) {
  Find<1>(finest_of_, cells, offset, finest, [this](int column, int row) -> const Finest& {
    return MakeFinest(column, row);
  });
}

void LikelihoodWindow::FindPairs(std::span<const GridCell> cells,
                                 GridCell offset,
                                 CellsAtATime& pairs) {
  Find<kPairSide>(pairs_of_, cells, offset, pairs, [this](int column, int row) -> const Pairs& {
    return MakePairs(column, row);
  });
}

template <int kCellSide, class SquareOfTile, class Make>
void LikelihoodWindow::Find(std::span<const SquareOfTile*> square_of,
                            std::span<const GridCell> cells,
                            GridCell offset,
                            CellsAtATime& found,
                            const Make& make) {
  constexpr int kMask = Tile::kSide - 1;
  const int x = offset.x - first_.x;
  const int y = offset.y - first_.y;
  const int columns = size_.x;
  const SquareOfTile* const* of_tiles = square_of.data();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int column = cells[i].x + x;
    const int row = cells[i].y + y;
    const int index = (row >> Tile::kBits) * columns + (column >> Tile::kBits);
    const SquareOfTile* of_tile = of_tiles[index];
    if (of_tile == nullptr) of_tile = &make(column >> Tile::kBits, row >> Tile::kBits);
    found[i] = of_tile->At((column & kMask) / kCellSide, (row & kMask) / kCellSide);
  }
}

}  // namespace qwsm
