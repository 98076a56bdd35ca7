// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/scenario.hpp"

namespace sim::testing {

/// One robot on an empty floor, steered from outside, without any noise.
ScenarioOptions EmptyFloor();

/// A layout with one robot that drives its route.
ScenarioOptions Drive(LayoutKind kind, int seed);

/// The paper's park: grass, a poor driver, 181 beams over 180 degrees at 1 Hz, useful to 20 m.
ScenarioOptions Park(int seed);

}  // namespace sim::testing
