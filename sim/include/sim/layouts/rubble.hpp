// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"
#include "sim/random.hpp"

namespace sim {

/// A collapsed floor: a hall full of slabs, bricks and rods at all angles.
struct RubbleOptions {
  double length_m = 24.0;
  double width_m = 16.0;
  int slabs = 40;             ///< Boxes of 0.4 to 2 m.
  int bricks = 120;           ///< Boxes of 5 to 30 cm.
  int rods = 30;              ///< Rods of 1 to 6 cm radius.
  double clearance_m = 0.55;  ///< Nothing lies nearer to the way than this.
};

template <class Visitor>
void Describe(Visitor& visit, RubbleOptions& o) {
  visit("length_m", o.length_m, {.help = "of the hall", .min = 8, .max = 500});
  visit("width_m", o.width_m, {.help = "of the hall", .min = 8, .max = 500});
  visit("slabs", o.slabs, {.help = "boxes of 0.4 to 2 m", .min = 0, .max = 10000});
  visit("bricks", o.bricks, {.help = "boxes of 5 to 30 cm", .min = 0, .max = 10000});
  visit("rods", o.rods, {.help = "rods of 1 to 6 cm radius", .min = 0, .max = 10000});
  visit(
      "clearance_m", o.clearance_m, {.help = "nothing is nearer to the way", .min = 0.3, .max = 3});
}

/// Makes a collapsed floor with a winding loop through the hall. The debris changes with the random
/// numbers, the way a little.
Place MakeRubble(const RubbleOptions& options, RandomEngine& random);

}  // namespace sim
