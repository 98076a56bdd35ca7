// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr double kReachSigmas = 2.5;   // Beyond, the likelihood is not worth storing.
constexpr std::uint8_t kOnPoint = 60;  // A cell counts as mapped by a point from here on.
constexpr double kSmallestDrift_m2 = 1e-6;
constexpr double kDriftStepsPerOctave = 5.0;

// Of the cell, 2^shift level-0 cells wide, that holds a level-0 cell.
int OffsetInTile(int shift, int x, int y) {
  const int column = (x & (Tile::kSide - 1)) >> shift;
  const int row = (y & (Tile::kSide - 1)) >> shift;
  return row * (Tile::kSide >> shift) + column;
}

// Smallest drifts along a row of a tile, of cells 2^shift times as wide, and what they are lowered
// to.
struct DriftRow {
  std::uint8_t* codes;
  int shift;
  std::uint8_t code;
};

// Raises the likelihoods of a tile's row, from one of its columns on, to those of a point.
// @param of_columns the point's profile from that column on.
void RaiseRow(std::span<const double> of_columns,
              double of_row,
              int column,
              std::uint8_t* likelihoods,
              const DriftRow& drift) {
  for (const double of_column : of_columns) {
    const auto likelihood = static_cast<std::uint8_t>(of_row * of_column);
    likelihoods[column] = std::max(likelihoods[column], likelihood);
    if (likelihood >= kOnPoint) {
      std::uint8_t& smallest = drift.codes[column >> drift.shift];
      smallest = std::min(smallest, drift.code);
    }
    ++column;
  }
}

}  // namespace

void LikelihoodPyramid::Insert(const Eigen::Vector2d& p_m, double drift_m2) {
  // A Gaussian is the product of its profiles along both axes, and so is its maximum in a box.
  Fill(p_m.x(), columns_);
  Fill(p_m.y(), rows_);
  const std::uint8_t drift_code = DriftCode(drift_m2);
  // In bits, so many of the coarsest cells, which reach farthest, are in a tile.
  constexpr int kBits = Tile::kBits - Tile::ShiftOf(kLevels - 1);
  const Profile& columns = columns_.back();
  const Profile& rows = rows_.back();
  for (int row = rows.first >> kBits; row <= rows.last() >> kBits; ++row) {
    for (int column = columns.first >> kBits; column <= columns.last() >> kBits; ++column) {
      Tile& tile = TileAt(column, row);
      for (int level = 0; level < kLevels; ++level) {
        const int side = Tile::kSide >> Tile::ShiftOf(level);
        Raise(tile, level, {column * side, row * side}, drift_code);
      }
    }
  }
}

// The profiles of a point along one axis, at all levels.
void LikelihoodPyramid::Fill(double center_m, Profiles& profiles) const {
  const int reach =
      static_cast<int>(std::ceil(kReachSigmas * options_.sigma_m / options_.cell_size_m));
  Profile& finest = profiles.front();
  finest.first = CellIndex(center_m) - reach;
  finest.values.clear();
  for (int cell = finest.first; cell <= finest.first + 2 * reach; ++cell) {
    const double sigmas = (options_.cell_size_m * (cell + 0.5) - center_m) / options_.sigma_m;
    finest.values.push_back(std::exp(-0.5 * sigmas * sigmas));
  }
  for (int level = 1; level < kLevels; ++level) {
    const auto i = static_cast<std::size_t>(level);
    profiles[i].Coarsen(profiles[i - 1], Tile::ShiftOf(level) - Tile::ShiftOf(level - 1));
  }
}

// From the cells of a level to those of the next, s = 2^shift times as wide: c holds the maximum
// over s c .. s c + 2 (s - 1).
void LikelihoodPyramid::Profile::Coarsen(const Profile& fine, int shift) {
  const int wide = 1 << shift;
  const int reach = 2 * (wide - 1);
  first = (fine.first - (wide - 1)) >> shift;
  values.clear();
  for (int c = first; c <= fine.last() >> shift; ++c) {
    const int from = std::max(fine.first, c << shift);
    const int to = std::min(fine.last(), (c << shift) + reach);
    values.push_back(*std::max_element(fine.At(from), fine.At(to) + 1));
  }
}

// Raises the cells of a tile that the profiles cover.
// @param first the tile's first cell of that level.
void LikelihoodPyramid::Raise(Tile& tile,
                              int level,
                              GridCell first,
                              std::uint8_t drift_code) const {
  const int side = Tile::kSide >> Tile::ShiftOf(level);
  const int drift_shift = Tile::DriftShiftOf(level) - Tile::ShiftOf(level);
  const Profile& columns = columns_[static_cast<std::size_t>(level)];
  const Profile& rows = rows_[static_cast<std::size_t>(level)];
  const int first_x = std::max(first.x, columns.first);
  const int last_x = std::min(first.x + side - 1, columns.last());
  if (last_x < first_x) return;
  const std::span<const double> of_columns(columns.At(first_x), columns.At(last_x) + 1);
  const int last_y = std::min(first.y + side - 1, rows.last());
  for (int y = std::max(first.y, rows.first); y <= last_y; ++y) {
    const int row = y - first.y;
    RaiseRow(of_columns,
             255.0 * *rows.At(y),
             first_x - first.x,
             tile.likelihoods(level) + row * side,
             {.codes = tile.drift_codes(level) + (row >> drift_shift) * (side >> drift_shift),
              .shift = drift_shift,
              .code = drift_code});
  }
}

LikelihoodTile& LikelihoodPyramid::TileAt(int column, int row) {
  std::uint32_t& tile = directory_[Key(column, row)].At(column, row);
  if (tile == Block::kNone) tile = tiles_.Add({});
  return tiles_[tile];
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

std::uint8_t LikelihoodPyramid::DriftCode(double drift_m2) {
  const double octaves = std::log2(std::max(drift_m2, kSmallestDrift_m2) / kSmallestDrift_m2);
  return static_cast<std::uint8_t>(std::min(254.0, std::round(kDriftStepsPerOctave * octaves)));
}

double LikelihoodPyramid::DriftOf(std::uint8_t drift_code) {
  return kSmallestDrift_m2 * std::exp2(drift_code / kDriftStepsPerOctave);
}

std::size_t LikelihoodPyramid::bytes() const {
  // A node of the directory holds a link beside the entry.
  constexpr std::size_t kEntry = sizeof(decltype(directory_)::value_type) + sizeof(void*);
  return tiles_.bytes() + directory_.size() * kEntry + directory_.bucket_count() * sizeof(void*);
}

}  // namespace qwsm
