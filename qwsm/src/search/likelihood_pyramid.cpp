// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr double kSmallestDrift_m2 = 1e-6;
constexpr int kDriftStepsPerOctave = 5;
constexpr int kMostDriftCode = LikelihoodPyramid::kUnmapped - 1;
// Of an octave, where the code rises: 2^0.1, 2^0.3 ..
constexpr std::array<double, kDriftStepsPerOctave> kDriftSteps = {1.0717734625362931,
                                                                  1.2311444133449163,
                                                                  1.4142135623730951,
                                                                  1.6245047927124711,
                                                                  1.8660659830736148};

// Of the cell, 2^shift level-0 cells wide, that holds a level-0 cell.
int OffsetInTile(int shift, int x, int y) {
  const int column = (x & (Tile::kSide - 1)) >> shift;
  const int row = (y & (Tile::kSide - 1)) >> shift;
  return row * (Tile::kSide >> shift) + column;
}

// Sixteen bytes side by side; every processor of the last twenty years computes with such groups.
using Sixteen = std::uint8_t __attribute__((vector_size(16)));
static_assert(LikelihoodStamp::kPadding == sizeof(Sixteen) && Tile::kSide % sizeof(Sixteen) == 0);

Sixteen Load(const std::uint8_t* bytes) {
  Sixteen sixteen;
  std::memcpy(&sixteen, bytes, sizeof sixteen);
  return sixteen;
}

void Raise(std::uint8_t* likelihoods, const std::uint8_t* of_point) {
  const Sixteen before = Load(likelihoods);
  const Sixteen to = Load(of_point);
  const Sixteen raised = before > to ? before : to;
  std::memcpy(likelihoods, &raised, sizeof raised);
}

// Lowers eight drift codes, each of two cells side by side, where one of these counts as mapped.
void LowerDrift(std::uint8_t* codes, const std::uint8_t* of_point, std::uint8_t drift_code) {
  using Eight = std::uint8_t __attribute__((vector_size(8)));
  using EightPairs = std::uint16_t __attribute__((vector_size(16)));
  static_assert(Tile::DriftShiftOf(0) == 1);
  const auto mapped = std::bit_cast<EightPairs>(Load(of_point) >= Tile::kMapped);
  const Eight are_mapped = __builtin_convertvector(mapped | mapped >> 8, Eight);
  const Eight to = (Eight{} + drift_code) | ~are_mapped;  // Where not mapped, the largest code.
  Eight before;
  std::memcpy(&before, codes, sizeof before);
  const Eight lowered = before < to ? before : to;
  std::memcpy(codes, &lowered, sizeof lowered);
}

}  // namespace

void LikelihoodPyramid::Insert(const Eigen::Vector2d& p_m, double drift_m2) {
  LayProfiles(p_m);
  FindTilesAroundPoint();
  const std::uint8_t drift_code = DriftCode(drift_m2);
  for (int row = around_.first.y; row <= around_.last.y; ++row) {
    for (int column = around_.first.x; column <= around_.last.x; ++column) {
      RaiseFinest({column, row}, drift_code);
    }
  }
  RaiseCoarse();
  LowerCoarseDrift(drift_code);
}

// A Gaussian is the product of its profiles along both axes, and so is its maximum in a box.
void LikelihoodPyramid::LayProfiles(const Eigen::Vector2d& p_m) {
  columns_.Lay(p_m.x(), CellIndex(p_m.x()), fall_);
  rows_.Lay(p_m.y(), CellIndex(p_m.y()), fall_);
  stamp_.Make(columns_.fine, rows_.fine);
}

void LikelihoodPyramid::Profiles::Lay(double center_m, int cell, const LikelihoodFall& fall) {
  fine.CenterAt(center_m, cell, fall);
  coarse.Coarsen(fine, Tile::ShiftOf(1));
  of_drift.Coarsen(fine, Tile::DriftShiftOf(1));
}

// Finds all tiles that hold cells to be raised, and makes those that are not there.
void LikelihoodPyramid::FindTilesAroundPoint() {
  const GridCell first{columns_.fine.first() >> Tile::kBits, rows_.fine.first() >> Tile::kBits};
  const GridCell last{columns_.fine.last() >> Tile::kBits, rows_.fine.last() >> Tile::kBits};
  if (!around_.tiles.empty() && first == around_.first && last == around_.last) return;
  around_.first = first;
  around_.last = last;
  around_.tiles.clear();
  for (int row = first.y; row <= last.y; ++row) {
    for (int column = first.x; column <= last.x; ++column) {
      around_.tiles.push_back(TileAt(column, row));
    }
  }
}

// Raises the finest cells of a tile to those of the point, and lowers their drift.
void LikelihoodPyramid::RaiseFinest(GridCell at, std::uint8_t drift_code) {
  const GridCell first{at.x * Tile::kSide, at.y * Tile::kSide};
  const LikelihoodProfile& columns = columns_.fine;
  const int first_row = std::max(first.y, rows_.fine.first());
  const int last_row = std::min(first.y + Tile::kSide - 1, rows_.fine.last());
  const int first_mapped = std::max(first_row, stamp_.first_mapped());
  const int last_mapped = std::min(last_row, stamp_.last_mapped());
  constexpr int kDriftSide = Tile::kSide >> Tile::DriftShiftOf(0);
  Tile& tile = TileAround(at);
  for (int x = 0; x < Tile::kSide; x += LikelihoodStamp::kPadding) {
    const int column = first.x + x - columns.first();  // Of the stamp.
    if (column > columns.last() - columns.first() || column <= -LikelihoodStamp::kPadding) continue;
    for (int row = first_row; row <= last_row; ++row) {
      Raise(tile.likelihoods(0) + (row - first.y) * Tile::kSide + x, stamp_.Row(row) + column);
    }
    for (int row = first_mapped; row <= last_mapped; ++row) {
      const int of_drift = (row - first.y) >> Tile::DriftShiftOf(0);
      LowerDrift(tile.drift_codes(0) + of_drift * kDriftSide + (x >> Tile::DriftShiftOf(0)),
                 stamp_.Row(row) + column,
                 drift_code);
    }
  }
}

// Calls visit(tile, cell, likelihood) for the cells of the profiles, 2^kShift finest ones wide.
template <int kShift, class Visit>
void LikelihoodPyramid::VisitCoarse(const LikelihoodProfile& columns,
                                    const LikelihoodProfile& rows,
                                    Visit visit) {
  constexpr int kBits = Tile::kBits - kShift;  // So many cells are in a tile.
  constexpr int kMask = (1 << kBits) - 1;
  const double* of_columns = columns.At(columns.first());
  const double* of_rows = rows.At(rows.first());
  for (int row = rows.first(); row <= rows.last(); ++row) {
    const double of_row = 255.0 * *of_rows++;
    Tile* tile = nullptr;
    for (int column = columns.first(); column <= columns.last(); ++column) {
      const bool is_first_of_tile = column == columns.first() || (column & kMask) == 0;
      if (is_first_of_tile) tile = &TileAround({column >> kBits, row >> kBits});
      const int cell = ((row & kMask) << kBits) + (column & kMask);
      visit(*tile, cell, static_cast<std::uint8_t>(of_row * of_columns[column - columns.first()]));
    }
  }
}

void LikelihoodPyramid::RaiseCoarse() {
  VisitCoarse<Tile::ShiftOf(1)>(
      columns_.coarse, rows_.coarse, [](Tile& tile, int cell, std::uint8_t likelihood) {
        std::uint8_t& greatest = tile.likelihoods(1)[cell];
        greatest = std::max(greatest, likelihood);
      });
}

void LikelihoodPyramid::LowerCoarseDrift(std::uint8_t drift_code) {
  VisitCoarse<Tile::DriftShiftOf(1)>(
      columns_.of_drift, rows_.of_drift, [=](Tile& tile, int cell, std::uint8_t likelihood) {
        std::uint8_t& smallest = tile.drift_codes(1)[cell];
        if (likelihood >= Tile::kMapped) smallest = std::min(smallest, drift_code);
      });
}

// One of the tiles around the point.
LikelihoodTile& LikelihoodPyramid::TileAround(GridCell at) {
  const int width = around_.last.x - around_.first.x + 1;
  const int i = (at.y - around_.first.y) * width + (at.x - around_.first.x);
  return tiles_[around_.tiles[static_cast<std::size_t>(i)]];
}

std::uint32_t LikelihoodPyramid::TileAt(int column, int row) {
  std::uint32_t& tile = directory_[Key(column, row)].At(column, row);
  if (tile == Block::kNone) tile = tiles_.Add({});
  return tile;
}

const LikelihoodTile* LikelihoodPyramid::FindTile(int column, int row) const {
  const auto entry = directory_.find(Key(column, row));
  return TileOf(entry == directory_.end() ? nullptr : &entry->second, column, row);
}

// @param block that of the tile, if there is one.
const LikelihoodTile* LikelihoodPyramid::TileOf(const Block* block, int column, int row) const {
  const std::uint32_t tile = block == nullptr ? Block::kNone : block->At(column, row);
  return tile == Block::kNone ? nullptr : &tiles_[tile];
}

std::vector<const LikelihoodTile*> LikelihoodPyramid::FindTiles(GridCell first,
                                                                GridCell count) const {
  std::vector<const Tile*> tiles;
  tiles.reserve(static_cast<std::size_t>(count.x * count.y));
  for (int row = first.y; row < first.y + count.y; ++row) {
    const Block* block = nullptr;
    for (int column = first.x; column < first.x + count.x; ++column) {
      const bool is_first_of_block = column == first.x || column % Block::kSide == 0;
      if (is_first_of_block) {
        const auto entry = directory_.find(Key(column, row));
        block = entry == directory_.end() ? nullptr : &entry->second;
      }
      tiles.push_back(TileOf(block, column, row));
    }
  }
  return tiles;
}

std::uint8_t LikelihoodPyramid::LikelihoodAt(int level, int x, int y) const {
  const Tile* tile = FindTile(x >> Tile::kBits, y >> Tile::kBits);
  if (tile == nullptr) return 0;
  return tile->likelihoods(level)[OffsetInTile(Tile::ShiftOf(level), x, y)];
}

std::uint8_t LikelihoodPyramid::DriftCodeAt(int level, int x, int y) const {
  const Tile* tile = FindTile(x >> Tile::kBits, y >> Tile::kBits);
  if (tile == nullptr) return kUnmapped;
  return tile->drift_codes(level)[OffsetInTile(Tile::DriftShiftOf(level), x, y)];
}

std::uint8_t LikelihoodPyramid::SmallestDriftCode(int level, GridCell center, int reach) const {
  const int shift = Tile::DriftShiftOf(level);
  const int bits = Tile::kBits - shift;  // So many cells are in a tile.
  const int mask = (1 << bits) - 1;
  const GridCell low{(center.x >> shift) - reach, (center.y >> shift) - reach};
  const GridCell high{low.x + 2 * reach, low.y + 2 * reach};
  std::uint8_t smallest = kUnmapped;
  for (int row = low.y >> bits; row <= high.y >> bits; ++row) {
    for (int column = low.x >> bits; column <= high.x >> bits; ++column) {
      const Tile* tile = FindTile(column, row);
      if (tile == nullptr) continue;
      const std::uint8_t* codes = tile->drift_codes(level);
      const int first_x = std::max(low.x - (column << bits), 0);
      const int last_x = std::min(high.x - (column << bits), mask);
      const int last_y = std::min(high.y - (row << bits), mask);
      for (int y = std::max(low.y - (row << bits), 0); y <= last_y; ++y) {
        for (int x = first_x; x <= last_x; ++x) {
          smallest = std::min(smallest, codes[(y << bits) + x]);
        }
      }
    }
  }
  return smallest;
}

// The logarithm needs no more than the exponent of the number, and between which of the steps of an
// octave the rest of it lies.
std::uint8_t LikelihoodPyramid::DriftCode(double drift_m2) {
  constexpr int kMantissaBits = 52;
  constexpr int kBias = 1023;
  const double ratio = std::max(drift_m2, kSmallestDrift_m2) / kSmallestDrift_m2;  // At least 1.
  const auto bits = std::bit_cast<std::uint64_t>(ratio);
  const int octaves = static_cast<int>(bits >> kMantissaBits) - kBias;  // Of a NaN very many.
  const std::uint64_t rest = bits & ((std::uint64_t{1} << kMantissaBits) - 1);
  const double mantissa =
      std::bit_cast<double>(rest | std::uint64_t{kBias} << kMantissaBits);  // 1 .. 2
  int code = kDriftStepsPerOctave * octaves;
  for (const double step : kDriftSteps) code += mantissa >= step ? 1 : 0;
  return static_cast<std::uint8_t>(std::min(code, kMostDriftCode));
}

double LikelihoodPyramid::DriftOf(std::uint8_t drift_code) {
  return kSmallestDrift_m2 * std::exp2(static_cast<double>(drift_code) / kDriftStepsPerOctave);
}

std::size_t LikelihoodPyramid::bytes() const {
  // A node of the directory holds a link beside the entry.
  constexpr std::size_t kEntry = sizeof(decltype(directory_)::value_type) + sizeof(void*);
  return tiles_.bytes() + directory_.size() * kEntry + directory_.bucket_count() * sizeof(void*);
}

}  // namespace qwsm
