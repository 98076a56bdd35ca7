// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "placement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sim {

Place FullPlace(const ScenarioOptions& scenario) {
  Place place = MakePlace(scenario.layout, static_cast<std::uint64_t>(scenario.seed));
  place.scenery = std::move(place.scenery) + scenario.scenery;
  return place;
}

bool TakesRouteOfLayout(const DriverOptions& driver) {
  return FollowsWaypoints(driver.kind) && driver.waypoints.empty();
}

RobotPlacement PlacementOf(const ScenarioOptions& scenario, const Place& place, std::size_t robot) {
  const RobotOptions& options = scenario.robots[robot];
  if (TakesRouteOfLayout(options.driver)) {
    const Route& whole = place.routes[robot % place.routes.size()];
    const auto passed = std::lround(options.start_on_route * static_cast<double>(whole.size()));
    const auto last_leg = static_cast<std::ptrdiff_t>(whole.size()) - 2;
    const Route route(whole.begin() + std::min<std::ptrdiff_t>(passed, last_leg), whole.end());
    return {.options = options, .T_world_robot = StartOf(route), .route = route};
  }
  return {.options = options,
          .T_world_robot = {options.start_x_m, options.start_y_m, options.start_heading_rad},
          .route = options.driver.waypoints};
}

}  // namespace sim
