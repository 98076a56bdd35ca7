// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/io/pictures/canvas.hpp"
#include "service/io/rescue/points_of_interest.hpp"

namespace qwsm::io {

/// What a map for the RoboCup Rescue League shows; all of it is in the frame `map`.
struct RescueScene {
  const OccupancyGrid& grid;
  std::vector<std::vector<Pose2>> paths;  ///< Path of each robot, from its start.
  std::vector<PointOfInterest> points;
  std::string name;  ///< Name of the file, which stands in it.
  int px_per_cell = 1;
  /// How far victims are found from a robot; what was in sight within that is drawn as searched.
  double searched_m = 0.0;
};

/// A picture of a map, and where it lies.
struct GeoPicture {
  PixelImage image;
  double pixel_m = 0.0;
  Eigen::Vector2d top_left_map_m;  ///< The upper left corner of the first pixel.

  /// The pixel, from the upper left corner of the picture, that a point lies in.
  Eigen::Vector2d ToPixel(const Eigen::Vector2d& p_map_m) const {
    return {(p_map_m.x() - top_left_map_m.x()) / pixel_m,
            (top_left_map_m.y() - p_map_m.y()) / pixel_m};
  }
};

/// Draws a map in colours and forms of the league's rules: chequers of a metre where nothing is
/// known, a grid of half a metre on what is free, walls, paths with an arrow at their start, marks
/// with their numbers, the name of the file, a scale of a metre, and the axes; x is to the right.
/// @throws std::runtime_error where nothing of the map is known, or it is too large to be drawn.
GeoPicture DrawRescueMap(const RescueScene& scene);

}  // namespace qwsm::io
