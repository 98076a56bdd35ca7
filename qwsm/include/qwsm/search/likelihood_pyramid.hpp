// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "qwsm/geometry/position.hpp"
#include "qwsm/search/detail/likelihood_stamp.hpp"
#include "qwsm/search/detail/likelihood_tile.hpp"
#include "qwsm/search/detail/paged_pool.hpp"

namespace qwsm {

/// Smallest cells that can be numbered as far as kFarthestCoordinate_m.
inline constexpr double kSmallestCell_m = 0.01;

struct LikelihoodPyramidOptions {
  double cell_size_m = 0.064;
  double sigma_m = 0.08;
};

template <class Visitor>
void Describe(Visitor& visit, LikelihoodPyramidOptions& o) {
  visit("cell_size_m",
        o.cell_size_m,
        {.help = "side of the finest cell of a wide search", .min = kSmallestCell_m, .max = 1});
  visit("sigma_m",
        o.sigma_m,
        {.help = "how far from a stored point a beam may end and still count",
         .min = 0.005,
         .max = 1});
}

/// A cell of a LikelihoodPyramid; of level 0 where nothing else is said.
struct GridCell {
  int x = 0;
  int y = 0;

  friend bool operator==(const GridCell&, const GridCell&) = default;
};

/// How likely a beam ends in each cell, finely and coarsely, for searches that go from the coarse
/// to the fine.
///
/// Level 0 holds the maximum over the stored points of exp(-d^2 / 2 sigma^2), scaled to 0..255. A
/// cell of level 1 holds the maximum of the four by four level-0 cells in it. The smallest drift of
/// the points is held as well, so that a search can be restricted to what was mapped with little
/// drift: in cells of two by two level-0 cells, and for level 1 of sixteen by sixteen.
///
/// Stored in square tiles that exist only where points are. Searches read a LikelihoodWindow.
class LikelihoodPyramid {
 public:
  using Tile = LikelihoodTile;
  static constexpr int kLevels = Tile::kLevels;
  static constexpr std::uint8_t kUnmapped = Tile::kUnmapped;

  explicit LikelihoodPyramid(const LikelihoodPyramidOptions& options = {})
      : options_(options),
        cells_per_metre_(1.0 / options.cell_size_m),
        fall_(options.cell_size_m, options.sigma_m) {}

  double cell_size_m() const { return options_.cell_size_m; }
  /// Raises the cells around a point. @pre |coordinate| < 2^30 cells, which is farther than
  /// kFarthestCoordinate_m and whatever is seen from there.
  void Insert(const Eigen::Vector2d& p_m, double drift_m2);

  /// Index of the level-0 cell that holds a coordinate.
  int CellIndex(double coordinate_m) const {
    constexpr int kShift = 1 << 30;  // What is positive is truncated downwards.
    static_assert(1.05 * kFarthestCoordinate_m / kSmallestCell_m < kShift);
    return static_cast<int>(coordinate_m * cells_per_metre_ + kShift) - kShift;
  }
  GridCell CellAt(const Eigen::Vector2d& p_m) const {
    return {CellIndex(p_m.x()), CellIndex(p_m.y())};
  }
  /// Likelihood of the cell of `level` around the level-0 cell (x, y); 0 where nothing is stored.
  std::uint8_t LikelihoodAt(int level, int x, int y) const;
  /// Drift code of the cell of `level` around the level-0 cell (x, y); kUnmapped where nothing is
  /// stored.
  std::uint8_t DriftCodeAt(int level, int x, int y) const;
  /// The smallest drift code of the cells of a level around the one at a level-0 cell.
  /// @param reach so many cells to each side.
  std::uint8_t SmallestDriftCode(int level, GridCell center, int reach) const;
  /// The tile of the level-0 cells column * kSide .. column * kSide + kSide - 1, and so for rows;
  /// null where nothing is stored. Valid until the next insertion.
  const Tile* FindTile(int column, int row) const;
  /// Finds the tiles of so many columns and rows from one on, row by row, as FindTile() does.
  std::vector<const Tile*> FindTiles(GridCell first, GridCell count) const;

  /// Drift variance on a logarithmic scale of 8 bits: monotone, a fifth of an octave per step.
  static std::uint8_t DriftCode(double drift_m2);
  /// Drift variance in m^2 that a code stands for.
  static double DriftOf(std::uint8_t drift_code);

  std::size_t bytes() const;

 private:
  // Where the tiles of a square of kSide x kSide tiles are.
  class Block {
   public:
    static constexpr int kBits = 4;
    static constexpr int kSide = 1 << kBits;
    static constexpr std::uint32_t kNone = ~0U;

    Block() { tiles_.fill(kNone); }
    std::uint32_t& At(int column, int row) { return tiles_[Index(column, row)]; }
    std::uint32_t At(int column, int row) const { return tiles_[Index(column, row)]; }

   private:
    static std::size_t Index(int column, int row) {
      return static_cast<std::size_t>((row & (kSide - 1)) * kSide + (column & (kSide - 1)));
    }

    std::array<std::uint32_t, std::size_t{kSide} * kSide> tiles_;
  };

  // Of the block that holds a tile.
  static std::uint64_t Key(int column, int row) {
    return std::uint64_t{static_cast<std::uint32_t>(column >> Block::kBits)} << 32 |
           static_cast<std::uint32_t>(row >> Block::kBits);
  }
  // Tiles of columns and rows from the first to the last, row by row.
  struct TileRange {
    GridCell first;
    GridCell last;
    std::vector<std::uint32_t> tiles;
  };

  // Along one axis.
  struct Profiles {
    void Lay(double center_m, int cell, const LikelihoodFall& fall);

    LikelihoodProfile fine;
    LikelihoodProfile coarse;
    LikelihoodProfile of_drift;  // Of the coarse cells of drift.
  };

  void LayProfiles(const Eigen::Vector2d& p_m);
  void FindTilesAroundPoint();
  std::uint32_t TileAt(int column, int row);
  const Tile* TileOf(const Block* block, int column, int row) const;
  void RaiseFinest(GridCell at, std::uint8_t drift_code);
  template <int kShift, class Visit>
  void VisitCoarse(const LikelihoodProfile& columns, const LikelihoodProfile& rows, Visit visit);
  void RaiseCoarse();
  void LowerCoarseDrift(std::uint8_t drift_code);
  Tile& TileAround(GridCell at);

  LikelihoodPyramidOptions options_;
  double cells_per_metre_;
  LikelihoodFall fall_;
  std::unordered_map<std::uint64_t, Block> directory_;  // By Key().
  PagedPool<Tile, 4> tiles_;
  // Of the point inserted last; kept for their memory.
  Profiles columns_;
  Profiles rows_;
  LikelihoodStamp stamp_;
  TileRange around_;  // The next point is mostly near.
};

}  // namespace qwsm
