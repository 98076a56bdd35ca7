// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/rubble.hpp"

#include <cmath>
#include <numbers>
#include <optional>

namespace sim {
namespace {

constexpr double kOuterWall_m = 0.2;
constexpr double kFromWalls_m = 2.0;  // Of the way.
constexpr int kWindings = 8;          // Way points round the hall.
constexpr int kPlacingAttempts = 200;

/// Round the hall, nearer to the middle at every second way point.
Route WindingLoop(const RubbleOptions& options, RandomEngine& random) {
  Route route;
  for (int i = 0; i < kWindings; ++i) {
    const double direction_rad = 2.0 * std::numbers::pi * i / kWindings;
    const double share = (i % 2 == 0 ? 1.0 : 0.55) * Uniform(random, 0.85, 1.0);
    route.push_back({share * (0.5 * options.length_m - kFromWalls_m) * std::cos(direction_rad),
                     share * (0.5 * options.width_m - kFromWalls_m) * std::sin(direction_rad)});
  }
  route.push_back(route.front());
  route.push_back(route[1]);
  return route;
}

/// At least `radius_m` from the outer walls.
Eigen::Vector2d AnyPlace(const RubbleOptions& options, double radius_m, RandomEngine& random) {
  const double x_m = Uniform(random, -1.0, 1.0) * (0.5 * options.length_m - radius_m);
  const double y_m = Uniform(random, -1.0, 1.0) * (0.5 * options.width_m - radius_m);
  return {x_m, y_m};
}

/// Somewhere in the hall where a thing of this size keeps clear of the way; nothing if the hall is
/// too full of way.
std::optional<Eigen::Vector2d> ClearPlace(const RubbleOptions& options,
                                          const Route& route,
                                          double radius_m,
                                          RandomEngine& random) {
  for (int attempt = 0; attempt < kPlacingAttempts; ++attempt) {
    const Eigen::Vector2d p_m = AnyPlace(options, radius_m, random);
    if (DistanceToRoute(p_m, route) > options.clearance_m + radius_m) return p_m;
  }
  return std::nullopt;
}

/// A kind of box: so many, with a longer side in this range.
struct BoxKind {
  int count = 0;
  double min_m = 0.0;
  double max_m = 0.0;
};

void AddBoxes(const BoxKind& kind,
              const RubbleOptions& options,
              Place& place,
              RandomEngine& random) {
  for (int i = 0; i < kind.count; ++i) {
    const double length_m = Uniform(random, kind.min_m, kind.max_m);
    const double width_m = Uniform(random, 0.3, 1.0) * length_m;
    const double heading_rad = Uniform(random, 0.0, std::numbers::pi);
    const auto p_m =
        ClearPlace(options, place.routes[0], 0.5 * std::hypot(length_m, width_m), random);
    if (!p_m) continue;
    place.scenery.boxes.push_back({.x_m = p_m->x(),
                                   .y_m = p_m->y(),
                                   .heading_rad = heading_rad,
                                   .length_m = length_m,
                                   .width_m = width_m});
  }
}

}  // namespace

Place MakeRubble(const RubbleOptions& options, RandomEngine& random) {
  Place place;
  place.routes = {WindingLoop(options, random)};
  const double x_m = 0.5 * options.length_m;
  const double y_m = 0.5 * options.width_m;
  AddWalls({{-x_m, -y_m}, {x_m, -y_m}, {x_m, y_m}, {-x_m, y_m}, {-x_m, -y_m}},
           kOuterWall_m,
           place.scenery);
  AddBoxes({options.slabs, 0.4, 2.0}, options, place, random);
  AddBoxes({options.bricks, 0.05, 0.3}, options, place, random);
  for (int i = 0; i < options.rods; ++i) {
    const double radius_m = Uniform(random, 0.01, 0.06);
    const auto p_m = ClearPlace(options, place.routes[0], radius_m, random);
    if (p_m) place.scenery.rounds.push_back({p_m->x(), p_m->y(), radius_m});
  }
  return place;
}

}  // namespace sim
