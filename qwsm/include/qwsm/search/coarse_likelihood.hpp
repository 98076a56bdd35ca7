// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
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
/// A level bounds squares of `w` offsets to a side, w = 1, 2, 4 ... in level-0 cells of the
/// pyramid, of a scan that is turned by up to so much that its far points move by w / 4, its near
/// ones by w / 8: for these, which are most, the bounds are the closer. (Parts of a cell may lead
/// into the cell before; the one after is not counted, or the finest bounds would tell little.)
class CoarseLikelihood {
 public:
  static constexpr int kLevels = 6;
  /// Side of the squares of offsets that a level bounds.
  static constexpr int WidthOf(int level) { return 1 << level; }
  /// By how much of that width far points move at most where the scan turns, near ones by half.
  static constexpr double kFarMove = 0.25;

  /// Where the points of a scan are. The order within each group does not matter.
  struct Cells {
    std::span<const GridCell> near;
    std::span<const GridCell> far;
  };
  /// Of a square of offsets, and of those right of it, above it, and right above it.
  using FourBounds = std::array<double, 4>;

  /// @param area in metres; outside of it nothing may be asked for.
  CoarseLikelihood(const LikelihoodPyramid& map, const Eigen::AlignedBox2d& area);

  /// Upper bounds of the mean likelihood, 0..1, of cells that are moved by any offset of a square.
  /// @param offset the first one of the square. @param needed where all four bounds are lower than
  /// that, any lower values may be returned.
  FourBounds BoundsOfFour(int level, const Cells& cells, GridCell offset, double needed) const;

 private:
  // The maxima over squares of `side` offsets. Its cells are 2^shift level-0 cells apart, and cell
  // c holds the maximum over the level-0 cells c 2^shift .. (c + 1) 2^shift + side - 2 in each
  // axis.
  struct Plane {
    Plane(int of_side, int of_shift, int columns, int rows);
    std::span<std::uint8_t> Row(int y) {
      return std::span(cells).subspan(Index(0, y), static_cast<std::size_t>(width));
    }
    std::span<const std::uint8_t> Row(int y) const {
      return std::span(cells).subspan(Index(0, y), static_cast<std::size_t>(width));
    }
    std::size_t Index(int x, int y) const { return static_cast<std::size_t>(y * width + x); }
    int stride() const { return 1 << shift; }
    int reach() const { return stride() + side - 1; }

    int side;
    int shift;
    int width;
    int height;
    std::vector<std::uint8_t> cells;
  };

  static Plane FinestPlane(const LikelihoodPyramid& map, GridCell first, GridCell tiles);
  static Plane Coarsened(const Plane& fine, int side, int shift);
  const Plane& At(int plane) const { return planes_[static_cast<std::size_t>(plane)]; }
  // The finest levels have one plane for all points.
  const Plane& NearPlane(int level) const { return At(level < 2 ? level : 2 * level - 2); }
  const Plane& FarPlane(int level) const { return At(level < 1 ? 0 : 2 * level - 1); }

  GridCell first_;             // Level-0 cell that all planes begin with.
  std::vector<Plane> planes_;  // From the finest level on, each for near points and for far.
};

}  // namespace qwsm
