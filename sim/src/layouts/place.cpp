// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/place.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sim {

qwsm::Pose2 StartOf(const Route& route) {
  assert(route.size() >= 2 && "a route leads somewhere");
  const Eigen::Vector2d way_m = route[1].position_m() - route[0].position_m();
  return {route[0].x_m, route[0].y_m, std::atan2(way_m.y(), way_m.x())};
}

double DistanceToRoute(const Eigen::Vector2d& p_m, const Route& route) {
  assert(!route.empty() && "a route has a place");
  double nearest_m = (p_m - route.front().position_m()).norm();
  for (std::size_t i = 1; i < route.size(); ++i) {
    const Eigen::Vector2d from_m = route[i - 1].position_m();
    const Eigen::Vector2d leg_m = route[i].position_m() - from_m;
    const double share =
        std::clamp((p_m - from_m).dot(leg_m) / std::max(leg_m.squaredNorm(), 1e-12), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (from_m + share * leg_m - p_m).norm());
  }
  return nearest_m;
}

Route Refined(const Route& route, double spacing_m) {
  Route refined;
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    const Eigen::Vector2d from_m = route[i].position_m();
    const Eigen::Vector2d leg_m = route[i + 1].position_m() - from_m;
    const int parts = std::max(1, static_cast<int>(std::ceil(leg_m.norm() / spacing_m)));
    for (int part = 0; part < parts; ++part) {
      const Eigen::Vector2d p_m = from_m + leg_m * part / parts;
      refined.push_back({p_m.x(), p_m.y()});
    }
  }
  if (!route.empty()) refined.push_back(route.back());
  return refined;
}

void AddWalls(const Route& corners, double thickness_m, SceneryOptions& scenery) {
  for (std::size_t i = 1; i < corners.size(); ++i) {
    scenery.walls.push_back({.from_x_m = corners[i - 1].x_m,
                             .from_y_m = corners[i - 1].y_m,
                             .to_x_m = corners[i].x_m,
                             .to_y_m = corners[i].y_m,
                             .thickness_m = thickness_m});
  }
}

}  // namespace sim
