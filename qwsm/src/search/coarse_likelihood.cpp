// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/coarse_likelihood.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace qwsm {
namespace {

constexpr int kTileSide = LikelihoodTile::kSide;

// Cells of the next finer level, from the one that begins with it on, that together reach as far as
// a cell of a level does. Up to level 2 both have the same stride, then the coarser one's is twice
// as long; what lies between the cells named they reach over themselves.
std::span<const int> PartsOf(int level) {
  static constexpr std::array<int, 2> kOfSecond = {0, 1};
  static constexpr std::array<int, 2> kOfThird = {0, 2};
  static constexpr std::array<int, 3> kOfOthers = {0, 4, 5};
  if (level == 1) return kOfSecond;
  if (level == 2) return kOfThird;
  return kOfOthers;
}

// Raises the cells of a row to those of another one, as far as that has any; or to every second one
// of them.
void RaiseRow(std::span<std::uint8_t> row, std::span<const std::uint8_t> by, int stride) {
  const std::size_t count = std::min(row.size(), stride == 1 ? by.size() : (by.size() + 1) / 2);
  std::uint8_t* const to = row.data();  // Bytes may be anything, to the compiler sizes, too.
  const std::uint8_t* const from = by.data();
  if (stride == 1) {
    for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], from[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = std::max(to[i], from[2 * i]);
  }
}

}  // namespace

CoarseLikelihood::Plane::Plane(int columns, int rows)
    : width(columns),
      height(rows),
      cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

CoarseLikelihood::CoarseLikelihood(const LikelihoodPyramid& map, const Eigen::AlignedBox2d& area) {
  const GridCell low = map.CellAt(area.min());
  const GridCell high = map.CellAt(area.max());
  const GridCell first{low.x >> LikelihoodTile::kBits, low.y >> LikelihoodTile::kBits};
  const GridCell tiles{(high.x >> LikelihoodTile::kBits) - first.x + 1,
                       (high.y >> LikelihoodTile::kBits) - first.y + 1};
  first_ = {first.x * kTileSide, first.y * kTileSide};
  const int stride = 1 << StrideShiftOf(0);
  planes_.emplace_back(tiles.x * kTileSide / stride, tiles.y * kTileSide / stride);
  const std::vector<const LikelihoodTile*> found = map.FindTiles(first, tiles);
  auto tile = found.begin();
  for (int row = 0; row < tiles.y; ++row) {
    for (int column = 0; column < tiles.x; ++column, ++tile) {
      if (*tile != nullptr) Raise(**tile, {column, row});
    }
  }
  for (int level = 1; level < kLevels; ++level) planes_.push_back(Coarsened(planes_.back(), level));
}

// The finest level: cell c holds the maximum over 2 c .. 2 c + 2.
void CoarseLikelihood::Raise(const LikelihoodTile& tile, GridCell at) {
  Plane& plane = planes_.front();
  const std::uint8_t* likelihood = tile.likelihoods(0);
  for (int y = at.y * kTileSide; y < (at.y + 1) * kTileSide; ++y) {
    for (int x = at.x * kTileSide; x < (at.x + 1) * kTileSide; ++x, ++likelihood) {
      if (*likelihood == 0) continue;
      for (int row = std::max(0, (y - 1) >> 1); row <= y >> 1; ++row) {
        for (int column = std::max(0, (x - 1) >> 1); column <= x >> 1; ++column) {
          plane.At(column, row) = std::max(plane.At(column, row), *likelihood);
        }
      }
    }
  }
}

// One axis after the other: the maximum in a square is that of its columns' maxima.
CoarseLikelihood::Plane CoarseLikelihood::Coarsened(const Plane& fine, int level) {
  const int shift = StrideShiftOf(level) - StrideShiftOf(level - 1);
  Plane rows(fine.width, (fine.height + shift) >> shift);
  for (const int part : PartsOf(level)) {
    for (int y = 0; y < rows.height && (y << shift) + part < fine.height; ++y) {
      RaiseRow(rows.Row(y), fine.Row((y << shift) + part), 1);
    }
  }
  Plane coarse((fine.width + shift) >> shift, rows.height);
  for (const int part : PartsOf(level)) {
    for (int y = 0; y < coarse.height; ++y) {
      RaiseRow(coarse.Row(y), rows.Row(y).subspan(static_cast<std::size_t>(part)), 1 << shift);
    }
  }
  return coarse;
}

double CoarseLikelihood::Bound(int level,
                               std::span<const GridCell> cells,
                               GridCell offset,
                               double needed) const {
  constexpr std::size_t kStride = 16;  // Points after which to ask whether to go on.
  constexpr int kFull = std::numeric_limits<std::uint8_t>::max();
  const Plane& plane = planes_[static_cast<std::size_t>(level)];
  const int shift = StrideShiftOf(level);
  const int quarter = (SideOf(level) + 3) / 4;
  const int x = offset.x - first_.x - quarter;
  const int y = offset.y - first_.y - quarter;
  const double full = kFull * static_cast<double>(cells.size());
  const auto needed_sum = static_cast<int>(needed * full);
  int sum = 0;
  while (!cells.empty()) {
    const auto next = cells.first(std::min(cells.size(), kStride));
    cells = cells.subspan(next.size());
    for (const GridCell& cell : next) sum += plane.At((cell.x + x) >> shift, (cell.y + y) >> shift);
    if (sum + kFull * static_cast<int>(cells.size()) < needed_sum) break;
  }
  return sum / full;
}

}  // namespace qwsm
