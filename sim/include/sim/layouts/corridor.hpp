// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"

namespace sim {

/// A zigzag like that of Figure 2 of Visser et al. (2009), then a straight stretch in which nothing
/// tells one place from another but one door.
struct CorridorOptions {
  double width_m = 2.0;
  int zigzag_legs = 6;
  double zigzag_leg_m = 6.0;
  double bend_rad = 1.2;      ///< Angle by which one leg turns away from the one before.
  double straight_m = 45.0;   ///< Length of the straight stretch; 0 leaves it out.
  double door_at_m = 30.0;    ///< Place of the door, from the beginning of the straight stretch.
  double door_width_m = 0.9;  ///< Width of the door; 0 leaves it out.
  bool returns = true;        ///< Whether the way leads back to the start.
  bool keeps_right = false;   ///< Whether robots leave room for those that come towards them.
};

template <class Visitor>
void Describe(Visitor& visit, CorridorOptions& o) {
  visit("width_m", o.width_m, {.help = "between the walls", .min = 0.8, .max = 20});
  visit("zigzag_legs", o.zigzag_legs, {.help = "legs of the zigzag", .min = 0, .max = 100});
  visit("zigzag_leg_m", o.zigzag_leg_m, {.help = "length of one leg", .min = 3, .max = 100});
  visit("bend_rad", o.bend_rad, {.help = "between one leg and the next", .min = 0, .max = 1.6});
  visit("straight_m",
        o.straight_m,
        {.help = "length of the stretch after it", .min = 0, .max = 1000});
  visit("door_at_m", o.door_at_m, {.help = "along the straight stretch", .min = 1, .max = 1000});
  visit("door_width_m", o.door_width_m, {.help = "width of the door", .min = 0, .max = 5});
  visit("returns", o.returns, {.help = "whether the way leads back to the start"});
  visit("keeps_right", o.keeps_right, {.help = "whether robots leave room for others to pass"});
}

template <class Report>
void Validate(const CorridorOptions& o, Report& report) {
  if (o.zigzag_legs == 0 && o.straight_m == 0.0) {
    report("zigzag_legs", "a corridor needs a zigzag leg or a straight stretch");
  }
  const bool has_door = o.straight_m > 0.0 && o.door_width_m > 0.0;
  if (has_door && o.door_at_m + 0.5 * o.door_width_m > o.straight_m) {
    report("door_at_m", "lies beyond the straight stretch");
  }
}

Place MakeCorridor(const CorridorOptions& options);

}  // namespace sim
