// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <algorithm>
#include <utility>

namespace qwsm {
namespace {

constexpr double kReachSigmas = 2.5;   // Beyond, the likelihood is not worth storing.
constexpr std::uint8_t kOnPoint = 60;  // A cell counts as mapped by a point from here on.
constexpr double kSmallestDrift_m2 = 1e-6;
constexpr double kDriftStepsPerOctave = 5.0;
constexpr int kFirstTiles = 8;  // Side of the first directory.

// A range of tile columns or rows.
struct Range {
  int first = 0;
  int count = 0;

  bool Contains(int tile) const { return tile >= first && tile < first + count; }

  // Grows by doubling towards the tile, which keeps the cost per insertion constant on average.
  Range GrownTo(int tile) const {
    if (count == 0) return {tile - kFirstTiles / 2, kFirstTiles};
    if (tile < first) {
      const int grown = std::max(first + count - tile, 2 * count);
      return {first + count - grown, grown};
    }
    if (tile >= first + count) return {first, std::max(tile - first + 1, 2 * count)};
    return *this;
  }
};

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const LikelihoodPyramidOptions& options) : options_(options) {}

void LikelihoodPyramid::Insert(const Eigen::Vector2d& p_m, double drift_m2) {
  const int center_x = CellIndex(p_m.x());
  const int center_y = CellIndex(p_m.y());
  const int reach =
      static_cast<int>(std::ceil(kReachSigmas * options_.sigma_m / options_.cell_size_m));
  // A Gaussian is the product of its profiles along both axes.
  const std::vector<double> columns = Profile(p_m.x(), center_x - reach, center_x + reach);
  const std::vector<double> rows = Profile(p_m.y(), center_y - reach, center_y + reach);
  const std::uint8_t drift_code = DriftCode(drift_m2);
  for (int y = 0; y <= 2 * reach; ++y) {
    for (int x = 0; x <= 2 * reach; ++x) {
      const auto likelihood = static_cast<std::uint8_t>(
          255.0 * columns[static_cast<std::size_t>(x)] * rows[static_cast<std::size_t>(y)]);
      if (likelihood == 0) continue;
      Raise(center_x - reach + x,
            center_y - reach + y,
            {.likelihood = likelihood, .drift_code = drift_code});
    }
  }
}

std::vector<double> LikelihoodPyramid::Profile(double center_m, int first, int last) const {
  std::vector<double> profile;
  profile.reserve(static_cast<std::size_t>(last - first + 1));
  for (int cell = first; cell <= last; ++cell) {
    const double sigmas = (options_.cell_size_m * (cell + 0.5) - center_m) / options_.sigma_m;
    profile.push_back(std::exp(-0.5 * sigmas * sigmas));
  }
  return profile;
}

void LikelihoodPyramid::Clear() { *this = LikelihoodPyramid(options_); }

void LikelihoodPyramid::Raise(int x, int y, Cell value) {
  if (value.likelihood < kOnPoint) value.drift_code = std::numeric_limits<std::uint8_t>::max();
  const Cell old = At(0, x, y);
  if (value.likelihood <= old.likelihood && value.drift_code >= old.drift_code) return;
  for (int level = 0; level < kLevels; ++level) {
    // Every cell whose range [c 2^l, c 2^l + 2^(l+1) - 2] holds the raised one.
    const int span = (1 << level) - 1;
    for (const int dy : {0, span}) {
      for (const int dx : {0, span}) {
        Cell& cell = Touch(level, x - dx, y - dy);
        cell.likelihood = std::max(cell.likelihood, value.likelihood);
        cell.drift_code = std::min(cell.drift_code, value.drift_code);
      }
    }
  }
}

LikelihoodPyramid::Cell& LikelihoodPyramid::Touch(int level, int x, int y) {
  const int column = x >> kTileBits;
  const int row = y >> kTileBits;
  GrowDirectory(column, row);
  std::uint32_t& tile = directory_[static_cast<std::size_t>(row - first_row_) * columns_ +
                                   static_cast<std::size_t>(column - first_column_)];
  if (tile == kEmptyTile) {
    tile = static_cast<std::uint32_t>(tiles_.size());
    tiles_.emplace_back();
  }
  return tiles_[tile][OffsetInTile(level, x, y)];
}

void LikelihoodPyramid::GrowDirectory(int column, int row) {
  const Range old_columns{first_column_, static_cast<int>(columns_)};
  const Range old_rows{first_row_, static_cast<int>(rows_)};
  if (old_columns.Contains(column) && old_rows.Contains(row)) return;
  const Range new_columns = old_columns.GrownTo(column);
  const Range new_rows = old_rows.GrownTo(row);
  const auto width = static_cast<std::size_t>(new_columns.count);
  std::vector<std::uint32_t> directory(width * static_cast<std::size_t>(new_rows.count),
                                       kEmptyTile);
  for (std::size_t y = 0; y < rows_; ++y) {
    const std::size_t new_y = y + static_cast<std::size_t>(first_row_ - new_rows.first);
    const std::size_t new_x = static_cast<std::size_t>(first_column_ - new_columns.first);
    std::copy_n(&directory_[y * columns_], columns_, &directory[new_y * width + new_x]);
  }
  directory_ = std::move(directory);
  first_column_ = new_columns.first;
  first_row_ = new_rows.first;
  columns_ = static_cast<std::uint32_t>(new_columns.count);
  rows_ = static_cast<std::uint32_t>(new_rows.count);
}

std::uint8_t LikelihoodPyramid::DriftCode(double drift_m2) {
  const double octaves = std::log2(std::max(drift_m2, kSmallestDrift_m2) / kSmallestDrift_m2);
  return static_cast<std::uint8_t>(std::min(254.0, std::round(kDriftStepsPerOctave * octaves)));
}

double LikelihoodPyramid::DriftOf(std::uint8_t drift_code) {
  return kSmallestDrift_m2 * std::exp2(drift_code / kDriftStepsPerOctave);
}

std::size_t LikelihoodPyramid::bytes() const {
  return tiles_.capacity() * sizeof(Tile) + directory_.capacity() * sizeof(std::int32_t);
}

}  // namespace qwsm
