// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace qwsm {

struct LikelihoodPyramidOptions {
  double cell_size_m = 0.064;
  double sigma_m = 0.08;
};

template <class Visitor>
void Describe(Visitor& visit, LikelihoodPyramidOptions& o) {
  visit("cell_size_m",
        o.cell_size_m,
        {.help = "side of the finest cell of a wide search", .min = 0.005, .max = 1});
  visit("sigma_m",
        o.sigma_m,
        {.help = "how far from a stored point a beam may end and still count",
         .min = 0.005,
         .max = 1});
}

/// How likely a beam ends in each cell, at the levels a coarse-to-fine search visits.
///
/// Level 0 holds the maximum over the stored points of exp(-d^2 / 2 sigma^2), scaled to 0..255. A
/// cell c of level l holds the maximum over the level-0 cells c 2^l .. c 2^l + 2^(l+1) - 2 in each
/// axis: an upper bound for a beam that ends anywhere in c and is then moved by 0 .. 2^l - 1 cells
/// (Olson 2009; Hess et al. 2016). Beside the likelihood each cell holds the smallest drift of the
/// points in it, so that a search can be restricted to what was mapped with little drift.
///
/// Stored in square tiles that exist only where points are, behind a directory that grows by
/// doubling: reading a cell takes constant time for any extent.
class LikelihoodPyramid {
 public:
  static constexpr int kLevels = 5;
  static constexpr std::uint8_t kUnmapped = std::numeric_limits<std::uint8_t>::max();

  struct Cell {
    std::uint8_t likelihood = 0;
    std::uint8_t drift_code = kUnmapped;  ///< See DriftCode().
  };

  explicit LikelihoodPyramid(const LikelihoodPyramidOptions& options = {});

  double cell_size_m() const { return options_.cell_size_m; }
  /// Raises the cells around a point.
  void Insert(const Eigen::Vector2d& p_m, double drift_m2);
  /// Forgets everything.
  void Clear();

  /// Index of the level-0 cell that holds a coordinate.
  int CellIndex(double coordinate_m) const {
    return static_cast<int>(std::floor(coordinate_m / options_.cell_size_m));
  }
  /// The cell of `level` around the level-0 cell (x, y); an empty cell where nothing is stored.
  Cell At(int level, int x, int y) const {
    const auto column = static_cast<std::uint32_t>((x >> kTileBits) - first_column_);
    const auto row = static_cast<std::uint32_t>((y >> kTileBits) - first_row_);
    if (column >= columns_ || row >= rows_) return {};
    return tiles_[directory_[std::size_t{row} * columns_ + column]][OffsetInTile(level, x, y)];
  }

  /// Drift variance on a logarithmic scale of 8 bits: monotone, a fifth of an octave per step.
  static std::uint8_t DriftCode(double drift_m2);
  static double DriftOf(std::uint8_t drift_code);

  std::size_t bytes() const;

 private:
  static constexpr int kTileBits = 6;
  static constexpr int kTileSide = 1 << kTileBits;
  // 64^2 + 32^2 + 16^2 + 8^2 + 4^2 cells: one tile of each level.
  static constexpr std::array<std::size_t, kLevels> kLevelStart = {0, 4096, 5120, 5376, 5440};
  static constexpr std::size_t kTileCells = 5456;
  static constexpr std::uint32_t kEmptyTile = 0;
  using Tile = std::array<Cell, kTileCells>;

  static std::size_t OffsetInTile(int level, int x, int y) {
    const int column = (x & (kTileSide - 1)) >> level;
    const int row = (y & (kTileSide - 1)) >> level;
    return kLevelStart[static_cast<std::size_t>(level)] +
           static_cast<std::size_t>((row << (kTileBits - level)) + column);
  }
  // Likelihood along one axis of the cells first .. last around a point.
  std::vector<double> Profile(double center_m, int first, int last) const;
  Cell& Touch(int level, int x, int y);
  void Raise(int x, int y, Cell value);
  void GrowDirectory(int column, int row);

  LikelihoodPyramidOptions options_;
  int first_column_ = 0;
  int first_row_ = 0;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
  std::vector<std::uint32_t> directory_;  // Row-major; kEmptyTile where nothing is stored.
  std::vector<Tile> tiles_ = std::vector<Tile>(1);  // The first one stays empty.
};

}  // namespace qwsm
