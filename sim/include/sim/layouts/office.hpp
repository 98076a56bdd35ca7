// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/layouts/place.hpp"
#include "sim/random.hpp"

namespace sim {

/// Two rows of rooms along a corridor, with doors ajar, tables on thin legs, cabinets and people.
/// Wings follow each other along the corridor; only its ends tell them apart.
struct OfficeOptions {
  int rooms_per_side = 4;      ///< In a wing.
  int wings = 1;               ///< Alike down to the furniture.
  double room_length_m = 6.0;  ///< Length along the corridor.
  double room_depth_m = 5.0;
  double corridor_width_m = 2.4;
  double door_width_m = 1.1;
  int tables_per_room = 1;
  int persons = 3;
  int routes = 1;  ///< Number of robots' routes; each begins in another room.
};

template <class Visitor>
void Describe(Visitor& visit, OfficeOptions& o) {
  visit("rooms_per_side", o.rooms_per_side, {.help = "rooms on each side", .min = 2, .max = 100});
  visit(
      "wings", o.wings, {.help = "wings that are alike, one after the other", .min = 1, .max = 20});
  visit("room_length_m", o.room_length_m, {.help = "along the corridor", .min = 4, .max = 30});
  visit("room_depth_m", o.room_depth_m, {.help = "away from the corridor", .min = 4, .max = 30});
  visit("corridor_width_m", o.corridor_width_m, {.help = "between walls", .min = 1.5, .max = 10});
  visit("door_width_m", o.door_width_m, {.help = "width of a door", .min = 0.8, .max = 3});
  visit("tables_per_room", o.tables_per_room, {.help = "tables in a room", .min = 0, .max = 4});
  visit("persons", o.persons, {.help = "people who walk about", .min = 0, .max = 1000});
  visit("routes", o.routes, {.help = "robots that get a way of their own", .min = 1, .max = 1000});
}

template <class Report>
void Validate(const OfficeOptions& o, Report& report) {
  if (o.door_width_m + 2.4 > o.room_length_m) {
    report("door_width_m", "leaves too little wall beside the door");
  }
}

/// Makes an office. Each way visits every room once and ends where it began. In the corridor robots
/// keep to the right, so that they can pass each other.
Place MakeOffice(const OfficeOptions& options, RandomEngine& random);

}  // namespace sim
