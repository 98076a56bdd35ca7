// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_pyramid.hpp"

#include <algorithm>

namespace qwsm {
namespace {

constexpr double kReachSigmas = 2.5;   // Beyond, the likelihood is not worth storing.
constexpr std::uint8_t kOnPoint = 60;  // A cell counts as mapped by a point from here on.
constexpr double kSmallestDrift_m2 = 1e-6;
constexpr double kDriftStepsPerOctave = 5.0;

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const LikelihoodPyramidOptions& options) : options_(options) {}

void LikelihoodPyramid::Insert(const Eigen::Vector2d& p_m, double drift_m2) {
  const int center_x = CellIndex(p_m.x());
  const int center_y = CellIndex(p_m.y());
  const int reach =
      static_cast<int>(std::ceil(kReachSigmas * options_.sigma_m / options_.cell_size_m));
  const double falloff = -0.5 / (options_.sigma_m * options_.sigma_m);
  const std::uint8_t drift_code = DriftCode(drift_m2);
  for (int y = center_y - reach; y <= center_y + reach; ++y) {
    for (int x = center_x - reach; x <= center_x + reach; ++x) {
      const Eigen::Vector2d cell_m = options_.cell_size_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      const auto likelihood =
          static_cast<std::uint8_t>(255.0 * std::exp(falloff * (cell_m - p_m).squaredNorm()));
      if (likelihood == 0) continue;
      Raise(x, y, {.likelihood = likelihood, .drift_code = drift_code});
    }
  }
}

void LikelihoodPyramid::Clear() {
  directory_.clear();
  tiles_.clear();
  first_column_ = first_row_ = columns_ = rows_ = 0;
}

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
  const std::int64_t column = std::int64_t{x} >> kTileBits;
  const std::int64_t row = std::int64_t{y} >> kTileBits;
  GrowDirectory(column, row);
  std::int32_t& tile =
      directory_[static_cast<std::size_t>((row - first_row_) * columns_ + column - first_column_)];
  if (tile < 0) {
    tile = static_cast<std::int32_t>(tiles_.size());
    tiles_.emplace_back();
  }
  return tiles_[static_cast<std::size_t>(tile)][OffsetInTile(level, x, y)];
}

void LikelihoodPyramid::GrowDirectory(std::int64_t column, std::int64_t row) {
  if (column >= first_column_ && row >= first_row_ && column < first_column_ + columns_ &&
      row < first_row_ + rows_) {
    return;
  }
  // Doubling towards the new tile keeps the cost per insertion constant on average.
  const auto grow = [](std::int64_t first, std::int64_t count, std::int64_t wanted) {
    if (count == 0) return std::pair{wanted - 4, std::int64_t{8}};
    if (wanted < first)
      return std::pair{std::min(wanted, first - count), count + std::max(first - wanted, count)};
    if (wanted >= first + count) return std::pair{first, std::max(wanted - first + 1, 2 * count)};
    return std::pair{first, count};
  };
  const auto [first_column, columns] = grow(first_column_, columns_, column);
  const auto [first_row, rows] = grow(first_row_, rows_, row);
  std::vector<std::int32_t> directory(static_cast<std::size_t>(columns * rows), -1);
  for (std::int64_t y = 0; y < rows_; ++y) {
    const auto source = directory_.begin() + y * columns_;
    std::copy(
        source,
        source + columns_,
        directory.begin() + (y + first_row_ - first_row) * columns + first_column_ - first_column);
  }
  directory_ = std::move(directory);
  first_column_ = first_column;
  first_row_ = first_row;
  columns_ = columns;
  rows_ = rows;
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
