// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"
#include "sim/robot.hpp"
#include "sim/scenario.hpp"

namespace sim {

/// What the layout puts up together with what the scenario adds.
Place FullPlace(const ScenarioOptions& scenario);

/// Whether a robot drives a route of the layout, from its beginning.
bool TakesRouteOfLayout(const DriverOptions& driver);

/// Says where a robot starts and where it goes.
/// @pre a robot that takes a route of the layout finds one
RobotPlacement PlacementOf(const ScenarioOptions& scenario, const Place& place, std::size_t robot);

}  // namespace sim
