// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

constexpr double kReachSigmas = 2.5;   // Beyond, the likelihood is not worth storing.
constexpr std::uint8_t kOnPoint = 60;  // A cell counts as mapped by a point from here on.
constexpr double kSmallestDrift_m2 = 1e-6;
constexpr double kDriftStepsPerOctave = 5.0;

int OffsetInTile(int level, int x, int y) {
  const int column = (x & (Tile::kSide - 1)) >> level;
  const int row = (y & (Tile::kSide - 1)) >> level;
  return row * Tile::SideAt(level) + column;
}

}  // namespace

void LikelihoodPyramid::Insert(const Eigen::Vector2d& p_m, double drift_m2) {
  // A Gaussian is the product of its profiles along both axes, and so is its maximum in a box.
  Fill(p_m.x(), columns_);
  Fill(p_m.y(), rows_);
  const std::uint8_t drift_code = DriftCode(drift_m2);
  constexpr int kBits =
      Tile::kBits - (kLevels - 1);  // Of the coarsest cells, which reach farthest.
  const Profile& columns = columns_.back();
  const Profile& rows = rows_.back();
  for (int row = rows.first >> kBits; row <= rows.last() >> kBits; ++row) {
    for (int column = columns.first >> kBits; column <= columns.last() >> kBits; ++column) {
      Tile& tile = TileAt(column, row);
      for (int level = 0; level < kLevels; ++level) {
        const int side = Tile::SideAt(level);
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
  for (std::size_t level = 1; level < profiles.size(); ++level) {
    profiles[level].Coarsen(profiles[level - 1]);
  }
}

// From the cells of a level to those of the next: c holds the maximum over 2c, 2c + 1 and 2c + 2.
void LikelihoodPyramid::Profile::Coarsen(const Profile& fine) {
  first = (fine.first - 1) >> 1;
  values.clear();
  for (int c = first; c <= fine.last() >> 1; ++c) {
    values.push_back(std::max({fine.At(2 * c), fine.At(2 * c + 1), fine.At(2 * c + 2)}));
  }
}

// Raises the cells of a tile that the profiles cover.
// @param first the tile's first cell of that level.
void LikelihoodPyramid::Raise(Tile& tile,
                              int level,
                              GridCell first,
                              std::uint8_t drift_code) const {
  const int side = Tile::SideAt(level);
  const Profile& columns = columns_[static_cast<std::size_t>(level)];
  const Profile& rows = rows_[static_cast<std::size_t>(level)];
  const int last_x = std::min(first.x + side - 1, columns.last());
  const int last_y = std::min(first.y + side - 1, rows.last());
  for (int y = std::max(first.y, rows.first); y <= last_y; ++y) {
    const double of_row = 255.0 * rows.At(y);
    for (int x = std::max(first.x, columns.first); x <= last_x; ++x) {
      const auto likelihood = static_cast<std::uint8_t>(
          of_row * columns.values[static_cast<std::size_t>(x - columns.first)]);
      const int cell = (y - first.y) * side + (x - first.x);
      std::uint8_t& stored = tile.likelihoods(level)[cell];
      stored = std::max(stored, likelihood);
      if (level < Tile::kFirstDriftLevel || likelihood < kOnPoint) continue;
      std::uint8_t& smallest = tile.drift_codes(level)[cell];
      smallest = std::min(smallest, drift_code);
    }
  }
}

LikelihoodTile& LikelihoodPyramid::TileAt(int column, int row) {
  const auto [entry, is_new] = directory_.try_emplace(Key(column, row), tiles_.next());
  if (is_new) tiles_.Add({});
  return tiles_[entry->second];
}

const LikelihoodTile* LikelihoodPyramid::FindTile(int column, int row) const {
  const auto entry = directory_.find(Key(column, row));
  return entry == directory_.end() ? nullptr : &tiles_[entry->second];
}

std::uint8_t LikelihoodPyramid::LikelihoodAt(int level, int x, int y) const {
  const Tile* tile = FindTile(x >> Tile::kBits, y >> Tile::kBits);
  return tile == nullptr ? 0 : tile->likelihoods(level)[OffsetInTile(level, x, y)];
}

std::uint8_t LikelihoodPyramid::DriftCodeAt(int level, int x, int y) const {
  const Tile* tile = FindTile(x >> Tile::kBits, y >> Tile::kBits);
  return tile == nullptr ? kUnmapped : tile->drift_codes(level)[OffsetInTile(level, x, y)];
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
