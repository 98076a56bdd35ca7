// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenery.hpp"

#include <cmath>

#include "gravity.hpp"

namespace sim {
namespace {

template <class Thing>
void Append(std::vector<Thing>& to, const std::vector<Thing>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void Build(const WallOptions& wall, PhysicsWorld& world) {
  const double run_x_m = wall.to_x_m - wall.from_x_m;
  const double run_y_m = wall.to_y_m - wall.from_y_m;
  // Longer by its thickness, so that walls that meet at their ends close the corner.
  const Rectangle outline{.length_m = std::hypot(run_x_m, run_y_m) + wall.thickness_m,
                          .width_m = wall.thickness_m};
  world.AddFixed(outline,
                 {0.5 * (wall.from_x_m + wall.to_x_m),
                  0.5 * (wall.from_y_m + wall.to_y_m),
                  std::atan2(run_y_m, run_x_m)});
}

void Build(const BoxOptions& box, PhysicsWorld& world) {
  const Rectangle outline{.length_m = box.length_m, .width_m = box.width_m};
  const qwsm::Pose2 T_world_box{box.x_m, box.y_m, box.heading_rad};
  if (box.mass_kg > 0.0) {
    world.AddLoose(outline, T_world_box, box.mass_kg, box.friction * box.mass_kg * kGravity_mps2);
  } else {
    world.AddFixed(outline, T_world_box);
  }
}

}  // namespace

SceneryOptions operator+(SceneryOptions a, const SceneryOptions& b) {
  Append(a.walls, b.walls);
  Append(a.boxes, b.boxes);
  Append(a.rounds, b.rounds);
  Append(a.persons, b.persons);
  return a;
}

void Build(const SceneryOptions& scenery, PhysicsWorld& world) {
  for (const WallOptions& wall : scenery.walls) Build(wall, world);
  for (const BoxOptions& box : scenery.boxes) Build(box, world);
  for (const RoundOptions& thing : scenery.rounds) {
    world.AddFixed(Disc{thing.radius_m}, {thing.x_m, thing.y_m, 0.0});
  }
}

}  // namespace sim
