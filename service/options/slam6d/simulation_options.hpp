// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/pitching_laser.hpp"
#include "sim/solid_world.hpp"

namespace slam6d::options {

/// Options of how a scenario of the plane is seen by a 3D scanner.
struct SimulationOptions {
  sim::SolidOptions world{};
  sim::PitchingLaserOptions laser{};
  double stop_every_m = 2.0;
};

template <class Visitor>
void Describe(Visitor& visit, SimulationOptions& o) {
  visit("world", o.world, {.help = "the scenario in space"});
  visit("laser", o.laser, {.help = "the 2D laser that nods"});
  visit(
      "stop_every_m", o.stop_every_m, {.help = "a scan for so much way", .min = 0.05, .max = 1e3});
}

}  // namespace slam6d::options
