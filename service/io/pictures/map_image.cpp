// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/map_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "service/io/pictures/axis.hpp"
#include "service/io/pictures/map_colors.hpp"

namespace qwsm::io {
namespace {

constexpr Color kMeshLine = FromBytes(226, 230, 236);

constexpr double kGridStep_px = 28.0;  // At least, between lines.
constexpr double kLongerSide_px = 1400.0;
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

  bool operator==(const Span&) const = default;
};

// For every pixel of a side, the cells under it, of `count` there are.
std::vector<Span> CellsUnder(int side_px, double px_per_cell, double offset_cells, int count) {
  constexpr double kOfACell = 1e-6;
  std::vector<Span> cells;
  for (int px = 0; px < side_px; ++px) {
    const double first = px / px_per_cell + offset_cells;
    const double last = (px + 1) / px_per_cell + offset_cells;
    cells.push_back({std::clamp(static_cast<int>(std::floor(first + kOfACell)), 0, count),
                     std::clamp(static_cast<int>(std::ceil(last - kOfACell)), 0, count)});
  }
  return cells;
}

// What the pixels of a row show, which lies over these rows of cells.
std::vector<CellState> MostTelling(const OccupancyGrid& grid,
                                   std::span<const Span> columns,
                                   const Span& rows) {
  std::vector<CellState> telling(columns.size(), CellState::kUnknown);
  for (int y = rows.first; y < rows.last; ++y) {
    for (std::size_t px = 0; px < columns.size(); ++px) {
      for (int x = columns[px].first; x < columns[px].last; ++x) {
        telling[px] = std::max(telling[px], grid.At(x, y));
      }
    }
  }
  return telling;
}

// Where a pixel of one side lies in the grid of lines drawn below the map.
struct Place {
  bool is_odd = false;   // The square between lines that its middle is in.
  bool is_line = false;  // The first pixel of a square, but for the first square.

  bool operator==(const Place&) const = default;
};

std::vector<Place> PlacesOf(int side_px, double first_m, double m_per_px, double square_m) {
  std::vector<Place> places;
  long last = 0;
  for (int px = 0; px < side_px; ++px) {
    const long square = std::lround(std::floor((first_m + (px + 0.5) * m_per_px) / square_m));
    places.push_back({.is_odd = square % 2 != 0, .is_line = px > 0 && square != last});
    last = square;
  }
  return places;
}

constexpr std::uint32_t kWallPixel = ToPixel(map_colors::kWall);
constexpr std::array kFreePixels{ToPixel(map_colors::kFree), ToPixel(kMeshLine)};
constexpr std::array kUnknownPixels{ToPixel(map_colors::kUnknownDark),
                                    ToPixel(map_colors::kUnknownLight)};

std::uint32_t PixelOf(CellState state, const Place& column, const Place& row) {
  switch (state) {
    case CellState::kOccupied:
      return kWallPixel;
    case CellState::kFree:
      return kFreePixels[row.is_line || column.is_line ? 1 : 0];
    case CellState::kUnknown:
      break;
  }
  return kUnknownPixels[row.is_odd != column.is_odd ? 1 : 0];
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
  const double px_per_cell = WholeScale(kLongerSide_px / cells.maxCoeff());
  low_map_m_ = grid.origin_map_m.array() - more_low * grid.cell_m;
  px_per_m_ = px_per_cell / grid.cell_m;
  width_px_ = static_cast<int>(std::ceil(cells.x() * px_per_cell - 1e-6));
  height_px_ = static_cast<int>(std::ceil(cells.y() * px_per_cell - 1e-6));
}

double MapView::grid_step_m() const {
  return std::max(1.0, RoundUpToNice(kGridStep_px / px_per_m_));
}

PixelImage RenderMap(const OccupancyGrid& grid, const MapView& view) {
  PixelImage image{.width_px = view.width_px(), .height_px = view.height_px(), .pixels = {}};
  const double m_per_px = 1.0 / view.px_per_m();
  const double px_per_cell = view.px_per_m() * grid.cell_m;
  const Eigen::Vector2d low_map_m = view.ToMap({0.0, image.height_px});
  const Eigen::Vector2d offset_cells = (low_map_m - grid.origin_map_m) / grid.cell_m;
  const double step_m = view.grid_step_m();
  const auto columns = PlacesOf(image.width_px, low_map_m.x(), m_per_px, step_m);
  const auto rows = PlacesOf(image.height_px, low_map_m.y(), m_per_px, step_m);
  const auto cell_columns = CellsUnder(image.width_px, px_per_cell, offset_cells.x(), grid.width);
  const auto cell_rows = CellsUnder(image.height_px, px_per_cell, offset_cells.y(), grid.height);

  image.pixels.resize(columns.size() * rows.size());
  auto pixel = image.pixels.begin();
  std::vector<CellState> states;
  for (std::size_t y = rows.size(); y-- > 0;) {
    const bool shows_the_same = y + 1 < rows.size() && cell_rows[y] == cell_rows[y + 1];
    if (shows_the_same && rows[y] == rows[y + 1]) {
      pixel = std::copy_n(pixel - image.width_px, image.width_px, pixel);
      continue;
    }
    if (!shows_the_same) states = MostTelling(grid, cell_columns, cell_rows[y]);
    pixel =
        std::ranges::transform(states, columns, pixel, [&](CellState state, const Place& column) {
          return PixelOf(state, column, rows[y]);
        }).out;
  }
  return image;
}

}  // namespace qwsm::io
