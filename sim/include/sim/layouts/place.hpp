// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/scenery.hpp"
#include "sim/waypoint.hpp"

namespace sim {

/// Scenery, and ways through it that are free of it. Robots beyond the last route share the routes;
/// see RobotOptions::start_on_route.
struct Place {
  SceneryOptions scenery;
  std::vector<Route> routes;
};

/// The pose at the beginning of a route, looking along it.
/// @pre the route has two different way points
qwsm::Pose2 StartOf(const Route& route);

/// The distance from a point to the nearest leg of a route.
/// @pre the route has a way point
double DistanceToRoute(const Eigen::Vector2d& p_m, const Route& route);

/// The route with further way points on its legs, at most `spacing_m` apart.
Route Refined(const Route& route, double spacing_m);

/// Adds walls along a polyline, with corners closed.
void AddWalls(const Route& corners, double thickness_m, SceneryOptions& scenery);

}  // namespace sim
