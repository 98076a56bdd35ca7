// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/likelihood_window.hpp"

#include <algorithm>

namespace qwsm {
namespace {

using Tile = LikelihoodTile;

}  // namespace

LikelihoodWindow::LikelihoodWindow(const LikelihoodPyramid& pyramid,
                                   GridCell low,
                                   GridCell high,
                                   std::uint8_t max_drift_code)
    : first_tile_{low.x >> Tile::kBits, low.y >> Tile::kBits},
      tiles_{(high.x >> Tile::kBits) - first_tile_.x + 1,
             (high.y >> Tile::kBits) - first_tile_.y + 1} {
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    planes_.emplace_back(Tile::SideAt(level), tiles_);
  }
  ForEachTile(pyramid, [&](const Tile* tile, GridCell at) {
    for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
      planes_[static_cast<std::size_t>(level)].Place(
          tile == nullptr ? nullptr : tile->likelihoods(level), 0, at);
    }
  });
  if (max_drift_code != LikelihoodPyramid::kUnmapped) ForgetDrifted(pyramid, max_drift_code);
}

template <class Visit>
void LikelihoodWindow::ForEachTile(const LikelihoodPyramid& pyramid, Visit visit) const {
  for (int row = 0; row < tiles_.y; ++row) {
    for (int column = 0; column < tiles_.x; ++column) {
      visit(pyramid.FindTile(first_tile_.x + column, first_tile_.y + row), GridCell{column, row});
    }
  }
}

// Sets the likelihood of cells to 0 that no surface with little drift is in.
void LikelihoodWindow::ForgetDrifted(const LikelihoodPyramid& pyramid,
                                     std::uint8_t max_drift_code) {
  for (int level = 0; level < LikelihoodPyramid::kLevels; ++level) {
    const int drift_level = std::max(level, Tile::kFirstDriftLevel);
    Plane drift(Tile::SideAt(drift_level), tiles_);
    ForEachTile(pyramid, [&](const Tile* tile, GridCell at) {
      drift.Place(tile == nullptr ? nullptr : tile->drift_codes(drift_level),
                  LikelihoodPyramid::kUnmapped,
                  at);
    });
    // Drift cells that hold the level-0 cells a cell is the maximum over.
    const auto first_of = [&](int cell) { return (cell << level) >> drift_level; };
    const auto last_of = [&](int cell) {
      return ((cell << level) + (2 << level) - 2) >> drift_level;
    };
    Plane& plane = planes_[static_cast<std::size_t>(level)];
    for (int y = 0; y < plane.height; ++y) {
      for (int x = 0; x < plane.width; ++x) {
        if (plane.At(x, y) == 0) continue;
        const std::uint8_t smallest =
            drift.Smallest({first_of(x), first_of(y)}, {last_of(x), last_of(y)});
        if (smallest > max_drift_code) plane.At(x, y) = 0;
      }
    }
  }
}

// Puts the rows of a tile in their place, or one value where there is no tile.
void LikelihoodWindow::Plane::Place(const std::uint8_t* tile, std::uint8_t otherwise, GridCell at) {
  for (int y = 0; y < side; ++y) {
    std::uint8_t* const row = &At(at.x * side, at.y * side + y);
    if (tile != nullptr) {
      std::copy_n(tile + y * side, side, row);
    } else {
      std::fill_n(row, side, otherwise);
    }
  }
}

// Of the cells low .. high that the plane has.
std::uint8_t LikelihoodWindow::Plane::Smallest(GridCell low, GridCell high) const {
  std::uint8_t smallest = LikelihoodPyramid::kUnmapped;
  for (int y = low.y; y <= std::min(high.y, height - 1); ++y) {
    for (int x = low.x; x <= std::min(high.x, width - 1); ++x)
      smallest = std::min(smallest, At(x, y));
  }
  return smallest;
}

}  // namespace qwsm
