// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm::test {

/// A straight wall without thickness.
struct Wall {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

/// A round column, a tree or a table leg.
struct Column {
  Eigen::Vector2d center_m;
  double radius_m = 0.1;
};

/// What a laser can hit, in the frame `world`.
struct World {
  std::vector<Wall> walls;
  std::vector<Column> columns;
};

/// A world and a way through it: straight from one point to the next.
struct Scene {
  World world;
  std::vector<Eigen::Vector2d> route_m;
};

/// The exact distance along a ray to the first wall or column, if any is hit. O(walls + columns).
/// @param direction unit vector.
std::optional<double> CastRay(const World& world,
                              const Eigen::Vector2d& origin_m,
                              const Eigen::Vector2d& direction);

/// Reads a scene from a drawing of square cells: `#` is solid, `o` a column in the middle of its
/// cell, digits and then lower-case letters (1 to 9, a to n) are the points of the route, anything
/// else is free. Rows end in line breaks, the first is the top; the lower-left corner of the
/// drawing is the origin. A place that the route passes twice is drawn in neighbouring cells.
/// @throws std::invalid_argument where a point of the route is missing or drawn twice.
Scene SceneFromDrawing(std::string_view drawing, double cell_m, double column_radius_m = 0.1);

/// The same scene elsewhere: walls along the axes are a special case for much that is tested.
Scene Moved(const Scene& scene, const Pose2& T_new_old);

}  // namespace qwsm::test
