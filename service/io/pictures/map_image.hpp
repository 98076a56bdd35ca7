// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/io/pictures/canvas.hpp"

namespace qwsm::io {

/// The part of the map that a picture shows, and how large.
///
/// A pixel is a whole number of cells or the other way round, so that no wall is drawn thicker than
/// its neighbour.
class MapView {
 public:
  /// Shows all of the grid and at least the rectangle, its longer side about 1400 pixels.
  MapView(const OccupancyGrid& grid,
          const Eigen::Vector2d& low_map_m,
          const Eigen::Vector2d& high_map_m);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  double px_per_m() const { return px_per_m_; }

  /// Where a point of the map is in the picture; y points down there.
  Eigen::Vector2d ToPixel(const Eigen::Vector2d& p_map_m) const {
    return {(p_map_m.x() - low_map_m_.x()) * px_per_m_,
            height_px_ - (p_map_m.y() - low_map_m_.y()) * px_per_m_};
  }
  Eigen::Vector2d ToMap(const Eigen::Vector2d& pixel_px) const {
    return {low_map_m_.x() + pixel_px.x() / px_per_m_,
            low_map_m_.y() + (height_px_ - pixel_px.y()) / px_per_m_};
  }

  /// Distance of the lines of the grid that is drawn: nice, and not too dense; in metres.
  double grid_step_m() const;

 private:
  Eigen::Vector2d low_map_m_;
  double px_per_m_ = 1.0;
  int width_px_ = 0;
  int height_px_ = 0;
};

/// Draws the grid as the RoboCup Rescue League draws maps: what is unknown a light checkerboard,
/// free space white with a faint grid, walls dark blue. A pixel of several cells is as its most
/// telling one: occupied, else free.
PixelImage RenderMap(const OccupancyGrid& grid, const MapView& view);

}  // namespace qwsm::io
