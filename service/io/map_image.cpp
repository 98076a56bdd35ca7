// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/map_image.hpp"

#include <algorithm>
#include <cmath>

#include "service/io/axis.hpp"

namespace qwsm::io {
namespace {

constexpr Color kUnknownDark = FromBytes(226, 226, 227);
constexpr Color kUnknownLight = FromBytes(237, 237, 238);
constexpr Color kFree = FromBytes(255, 255, 255);
constexpr Color kGridLine = FromBytes(226, 230, 236);
constexpr Color kWall = FromBytes(0, 40, 120);

constexpr double kGridStepPx = 28.0;  // At least, between lines.
constexpr double kLongerSidePx = 1400.0;
constexpr double kMostPxPerCell = 20.0;

// Pixels per cell: a whole number, or one over it.
double WholeScale(double px_per_cell) {
  if (px_per_cell >= 1.0) return std::min(std::round(px_per_cell), kMostPxPerCell);
  return 1.0 / std::round(1.0 / px_per_cell);
}

// The half-open range of cells that a pixel of one row or column covers.
struct Span {
  int first = 0;
  int last = 0;
};

Span CellsUnder(int first_px, double px_per_cell, double offset_cells, int count) {
  const double first = first_px / px_per_cell + offset_cells;
  const double last = (first_px + 1) / px_per_cell + offset_cells;
  constexpr double kTolerance = 1e-6;
  return {std::clamp(static_cast<int>(std::floor(first + kTolerance)), 0, count),
          std::clamp(static_cast<int>(std::ceil(last - kTolerance)), 0, count)};
}

CellState MostTelling(const OccupancyGrid& grid, const Span& columns, const Span& rows) {
  CellState telling = CellState::kUnknown;
  for (int y = rows.first; y < rows.last; ++y) {
    for (int x = columns.first; x < columns.last; ++x) {
      telling = std::max(telling, grid.At(x, y));
    }
  }
  return telling;
}

// For every pixel of a side, the index of the grid square that its middle is in.
std::vector<long> SquareOfPixels(int count, double first_m, double step_m, double square_m) {
  std::vector<long> squares;
  for (int i = 0; i < count; ++i) {
    squares.push_back(std::lround(std::floor((first_m + (i + 0.5) * step_m) / square_m)));
  }
  return squares;
}

bool Changes(const std::vector<long>& squares, int at) {
  const auto index = static_cast<std::size_t>(at);
  return index > 0 && squares[index] != squares[index - 1];
}

}  // namespace

MapView::MapView(const OccupancyGrid& grid,
                 const Eigen::Vector2d& low_map_m,
                 const Eigen::Vector2d& high_map_m) {
  const Eigen::Vector2d grid_high_m =
      grid.origin_map_m + grid.cell_m * Eigen::Vector2d(grid.width, grid.height);
  // In whole cells around the grid's.
  const Eigen::Array2d more_low =
      ((grid.origin_map_m - low_map_m) / grid.cell_m).array().ceil().max(0.0);
  const Eigen::Array2d more_high =
      ((high_map_m - grid_high_m) / grid.cell_m).array().ceil().max(0.0);
  const Eigen::Array2d cells = Eigen::Array2d(grid.width, grid.height) + more_low + more_high;
  const double px_per_cell = WholeScale(kLongerSidePx / cells.maxCoeff());
  low_map_m_ = grid.origin_map_m.array() - more_low * grid.cell_m;
  px_per_m_ = px_per_cell / grid.cell_m;
  width_px_ = static_cast<int>(std::ceil(cells.x() * px_per_cell - 1e-6));
  height_px_ = static_cast<int>(std::ceil(cells.y() * px_per_cell - 1e-6));
}

double MapView::grid_step_m() const {
  return std::max(1.0, RoundUpToNice(kGridStepPx / px_per_m_));
}

PixelImage RenderMap(const OccupancyGrid& grid, const MapView& view) {
  PixelImage image{.width_px = view.width_px(), .height_px = view.height_px(), .pixels = {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width_px) *
                       static_cast<std::size_t>(image.height_px));
  const double m_per_px = 1.0 / view.px_per_m();
  const double px_per_cell = view.px_per_m() * grid.cell_m;
  const Eigen::Vector2d low_map_m = view.ToMap({0.0, image.height_px});
  const Eigen::Vector2d offset_cells = (low_map_m - grid.origin_map_m) / grid.cell_m;
  const double step_m = view.grid_step_m();
  const std::vector<long> columns = SquareOfPixels(image.width_px, low_map_m.x(), m_per_px, step_m);
  const std::vector<long> rows = SquareOfPixels(image.height_px, low_map_m.y(), m_per_px, step_m);

  for (int from_below = image.height_px - 1; from_below >= 0; --from_below) {
    const Span cell_rows = CellsUnder(from_below, px_per_cell, offset_cells.y(), grid.height);
    const bool row_line = Changes(rows, from_below);
    for (int x = 0; x < image.width_px; ++x) {
      const Span cell_columns = CellsUnder(x, px_per_cell, offset_cells.x(), grid.width);
      const CellState state = MostTelling(grid, cell_columns, cell_rows);
      const long square =
          columns[static_cast<std::size_t>(x)] + rows[static_cast<std::size_t>(from_below)];
      const Color unknown = square % 2 == 0 ? kUnknownDark : kUnknownLight;
      const Color free = row_line || Changes(columns, x) ? kGridLine : kFree;
      image.pixels.push_back(ToPixel(state == CellState::kOccupied ? kWall
                                     : state == CellState::kFree   ? free
                                                                   : unknown));
    }
  }
  return image;
}

}  // namespace qwsm::io
