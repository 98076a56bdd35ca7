// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace sim {

/// A place to go to, in the world.
struct WaypointOptions {
  double x_m = 0.0;
  double y_m = 0.0;

  Eigen::Vector2d position_m() const { return {x_m, y_m}; }
};

template <class Visitor>
void Describe(Visitor& visit, WaypointOptions& o) {
  visit("x_m", o.x_m, {.help = "place in the world", .min = -1e4, .max = 1e4});
  visit("y_m", o.y_m, {.help = "place in the world", .min = -1e4, .max = 1e4});
}

using Route = std::vector<WaypointOptions>;

}  // namespace sim
