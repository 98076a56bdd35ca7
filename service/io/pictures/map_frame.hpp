// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "service/io/pictures/canvas.hpp"
#include "service/io/pictures/legend.hpp"
#include "service/io/pictures/map_image.hpp"

namespace qwsm::io {

/// A map in a frame with a legend below: a scale, the distance of the grid lines, the extent, and
/// what else is drawn.
class MapFrame {
 public:
  MapFrame(const OccupancyGrid& grid, const MapView& view, std::vector<LegendItem> items);

  Canvas& canvas() { return canvas_; }
  Eigen::Vector2d ToCanvas(const Eigen::Vector2d& p_map_m) const {
    return corner_px_ + view_.ToPixel(p_map_m);
  }
  /// The map's part of the canvas.
  Rectangle map_area() const {
    return {.corner_px = corner_px_, .size_px = {view_.width_px(), view_.height_px()}};
  }

 private:
  MapFrame(const OccupancyGrid& grid, const MapView& view, const Legend& legend);

  MapView view_;
  Canvas canvas_;
  Eigen::Vector2d corner_px_;  // Corner of the map.
};

}  // namespace qwsm::io
