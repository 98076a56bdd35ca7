// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/mapping/relevant_scan.hpp"

namespace qwsm {

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// A map of square cells along the axes of the frame `map`.
struct OccupancyGrid {
  double cell_m = 0.0;
  Eigen::Vector2d origin_map_m = Eigen::Vector2d::Zero();  ///< Lower-left corner of cell (0, 0).
  int width = 0;                                           ///< Cells along x.
  int height = 0;                                          ///< Cells along y.
  std::vector<CellState> cells;                            ///< Row by row, lowest y first.

  /// @pre 0 <= x < width, 0 <= y < height.
  CellState At(int x, int y) const { return cells[Index(x, y)]; }
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

struct OccupancyGridOptions {
  double cell_m = 0.05;
  double usable_range_m = 30.0;
  double miss_free_range_m = 5.0;
  double occupied_share = 0.25;
  int max_megacells = 64;
};

template <class Visitor>
void Describe(Visitor& visit, OccupancyGridOptions& o) {
  visit("cell_m", o.cell_m, {.help = "side of a cell", .min = 1e-3, .max = 100});
  visit("usable_range_m",
        o.usable_range_m,
        {.help = "readings beyond say only that the way is free so far", .min = 0, .max = 1e4});
  visit("miss_free_range_m",
        o.miss_free_range_m,
        {.help = "how far the way is taken as free where there was no echo", .min = 0, .max = 1e4});
  visit("occupied_share",
        o.occupied_share,
        {.help = "a cell is occupied if at least this share of the scans that saw it hit it",
         .min = 0,
         .max = 1});
  visit("max_megacells",
        o.max_megacells,
        {.help = "larger maps, in million cells, are not rendered", .min = 1, .max = 4000});
}

enum class RenderStatus {
  kRendered,
  kNothingMeasured,  ///< No scan has a beam that says anything.
  kTooLarge,         ///< The map would have too many cells, or lies absurdly far from its origin.
};

struct [[nodiscard]] OccupancyGridResult {
  RenderStatus status = RenderStatus::kNothingMeasured;
  OccupancyGrid grid;          ///< Empty unless rendered.
  double extent_x_m = 0;       ///< Extent of what was measured; may be infinite when too large.
  double extent_y_m = 0;       ///< Extent of what was measured; may be infinite when too large.
  double smallest_cell_m = 0;  ///< Smallest cell at which the map would not be too large.
};

/// Renders what the scans saw. A scan counts once for every cell: as hit if a beam ended there,
/// else as free if a beam passed through, so that walls seen at a grazing angle stay. A lone
/// miss is taken as a lost echo, not as free space. The order of the scans does not matter where
/// fewer than 65 536 of them look. Scans whose pose is not finite are left out. O(cells + sum over
/// beams of range / cell); 4.2 bytes per cell of the tiles that beams pass, and 1 per cell of the
/// grid.
OccupancyGridResult RenderOccupancyGrid(std::span<const RelevantScan> scans,
                                        const OccupancyGridOptions& options = {});

}  // namespace qwsm
