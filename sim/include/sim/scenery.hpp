// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sim/person.hpp"
#include "sim/physics_world.hpp"

namespace sim {

/// A straight wall along its centre line.
struct WallOptions {
  double from_x_m = 0.0;
  double from_y_m = 0.0;
  double to_x_m = 0.0;
  double to_y_m = 0.0;
  double thickness_m = 0.1;
};

template <class Visitor>
void Describe(Visitor& visit, WallOptions& o) {
  visit("from_x_m", o.from_x_m, {.help = "one end", .min = -1e4, .max = 1e4});
  visit("from_y_m", o.from_y_m, {.help = "one end", .min = -1e4, .max = 1e4});
  visit("to_x_m", o.to_x_m, {.help = "the other end", .min = -1e4, .max = 1e4});
  visit("to_y_m", o.to_y_m, {.help = "the other end", .min = -1e4, .max = 1e4});
  visit("thickness_m", o.thickness_m, {.help = "thickness", .min = 0.01, .max = 100});
}

/// A box, fixed or, if it has a mass, one that can be pushed about.
struct BoxOptions {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  double length_m = 1.0;
  double width_m = 1.0;
  double mass_kg = 0.0;
  double friction = 0.5;  ///< Friction on the ground.
};

template <class Visitor>
void Describe(Visitor& visit, BoxOptions& o) {
  visit("x_m", o.x_m, {.help = "centre", .min = -1e4, .max = 1e4});
  visit("y_m", o.y_m, {.help = "centre", .min = -1e4, .max = 1e4});
  visit("heading_rad", o.heading_rad, {.help = "direction of its length", .min = -7, .max = 7});
  visit("length_m", o.length_m, {.help = "length", .min = 0.02, .max = 1e4});
  visit("width_m", o.width_m, {.help = "width", .min = 0.02, .max = 1e4});
  visit("mass_kg", o.mass_kg, {.help = "mass; 0 cannot be moved", .min = 0, .max = 1e5});
  visit("friction", o.friction, {.help = "on the ground, if it moves", .min = 0, .max = 3});
}

/// A tree, a column or a table leg.
struct RoundOptions {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.2;
};

template <class Visitor>
void Describe(Visitor& visit, RoundOptions& o) {
  visit("x_m", o.x_m, {.help = "centre", .min = -1e4, .max = 1e4});
  visit("y_m", o.y_m, {.help = "centre", .min = -1e4, .max = 1e4});
  visit("radius_m", o.radius_m, {.help = "radius", .min = 0.01, .max = 1000});
}

/// What stands and walks about in a world.
struct SceneryOptions {
  std::vector<WallOptions> walls{};
  std::vector<BoxOptions> boxes{};
  std::vector<RoundOptions> rounds{};
  std::vector<PersonOptions> persons{};
};

template <class Visitor>
void Describe(Visitor& visit, SceneryOptions& o) {
  visit("walls", o.walls, {.help = "straight walls"});
  visit("boxes", o.boxes, {.help = "boxes, fixed or to be pushed"});
  visit("rounds", o.rounds, {.help = "trees, columns, table legs"});
  visit("persons", o.persons, {.help = "people who walk about"});
}

/// The scenery of both.
SceneryOptions operator+(SceneryOptions a, const SceneryOptions& b);

/// Puts walls, boxes and round things into the world; persons enter by their own constructor.
void Build(const SceneryOptions& scenery, PhysicsWorld& world);

}  // namespace sim
