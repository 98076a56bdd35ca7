// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/search/likelihood_pyramid.hpp"

namespace qwsm {

/// Upper bounds of the likelihoods of a pyramid over a wide area: what a search of a whole map
/// works with. A pyramid's own coarse levels serve small windows: they are cheap to keep up to
/// date, but one cell reaches over twice the offsets that it bounds, and to a search that begins
/// with nothing every wall seems to be everywhere.
///
/// A level bounds squares of `s` offsets to a side, s = 2, 4, 8 ..., in level-0 cells of the
/// pyramid. Its cells are `t` apart, a quarter of s where s is 8 or more, and cell c holds the
/// maximum over the level-0 cells c t .. c t + t + s - 2 in each axis.
class CoarseLikelihood {
 public:
  static constexpr int kLevels = 6;
  /// Side of the squares of offsets that a level bounds.
  static constexpr int SideOf(int level) { return 1 << (level + 1); }

  /// @param area in metres; outside of it nothing may be asked for.
  CoarseLikelihood(const LikelihoodPyramid& map, const Eigen::AlignedBox2d& area);

  /// Upper bound of the mean likelihood, 0..1, of cells that are moved by an offset, by up to half
  /// the level's side more along both axes, and each by up to a quarter of it in any direction.
  /// @param needed where the bound is lower than that, any lower value may be returned.
  double Bound(int level, std::span<const GridCell> cells, GridCell offset, double needed) const;

 private:
  // The cells of a level, row by row.
  struct Plane {
    Plane(int columns, int rows);
    std::uint8_t& At(int x, int y) { return cells[Index(x, y)]; }
    std::uint8_t At(int x, int y) const { return cells[Index(x, y)]; }
    std::span<std::uint8_t> Row(int y) {
      return std::span(cells).subspan(Index(0, y), static_cast<std::size_t>(width));
    }
    std::span<const std::uint8_t> Row(int y) const {
      return std::span(cells).subspan(Index(0, y), static_cast<std::size_t>(width));
    }

    int width;
    int height;
    std::vector<std::uint8_t> cells;

   private:
    std::size_t Index(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
  };

  // A cell is 2^StrideShiftOf(level) level-0 cells apart from the next.
  static constexpr int StrideShiftOf(int level) { return level < 3 ? 1 : level - 1; }
  void Raise(const LikelihoodTile& tile, GridCell at);
  static Plane Coarsened(const Plane& fine, int level);

  GridCell first_;             // Level-0 cell that all planes begin with.
  std::vector<Plane> planes_;  // By level.
};

}  // namespace qwsm
