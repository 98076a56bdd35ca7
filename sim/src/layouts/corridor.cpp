// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/layouts/corridor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sim {
namespace {

constexpr double kWallThickness_m = 0.1;
constexpr double kNicheDepth_m = 1.5;
constexpr double kFromEnds_m = 1.0;  // The way begins and ends so far from the end walls.

WaypointOptions ToWaypoint(const Eigen::Vector2d& p_m) { return {p_m.x(), p_m.y()}; }

Eigen::Vector2d LeftOf(const Eigen::Vector2d& direction) { return {-direction.y(), direction.x()}; }

/// Along the middle of the corridor: legs that bend by turns to the right and to the left, then the
/// straight stretch along x.
std::vector<Eigen::Vector2d> CentreLine(const CorridorOptions& options) {
  std::vector<Eigen::Vector2d> line{{0.0, 0.0}};
  for (int leg = 0; leg < options.zigzag_legs; ++leg) {
    const double heading_rad = (leg % 2 == 0 ? 0.5 : -0.5) * options.bend_rad;
    line.emplace_back(line.back() + options.zigzag_leg_m * Eigen::Vector2d(std::cos(heading_rad),
                                                                           std::sin(heading_rad)));
  }
  if (options.straight_m > 0.0) {
    line.emplace_back(line.back() + Eigen::Vector2d(options.straight_m, 0.0));
  }
  return line;
}

/// The line shifted to its left by `offset_m`, with mitred corners.
std::vector<Eigen::Vector2d> Shifted(const std::vector<Eigen::Vector2d>& line, double offset_m) {
  std::vector<Eigen::Vector2d> shifted;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::size_t leg_before = i == 0 ? 0 : i - 1;
    const std::size_t leg_after = std::min(i, line.size() - 2);
    const Eigen::Vector2d before = LeftOf((line[leg_before + 1] - line[leg_before]).normalized());
    const Eigen::Vector2d after = LeftOf((line[leg_after + 1] - line[leg_after]).normalized());
    const Eigen::Vector2d bisector = (before + after).normalized();
    shifted.emplace_back(line[i] + offset_m / bisector.dot(before) * bisector);
  }
  return shifted;
}

Route ToRoute(const std::vector<Eigen::Vector2d>& line) {
  Route route;
  std::ranges::transform(line, std::back_inserter(route), ToWaypoint);
  return route;
}

/// The left wall along the straight stretch, with a door in it and a niche behind the door.
Route WallWithDoor(const CorridorOptions& options,
                   const Eigen::Vector2d& from_m,
                   const Eigen::Vector2d& to_m) {
  const double door_m = std::clamp(from_m.x() + options.door_at_m, from_m.x(), to_m.x());
  const double left_m = door_m - 0.5 * options.door_width_m;
  const double right_m = door_m + 0.5 * options.door_width_m;
  const double y_m = from_m.y();
  return {{from_m.x(), y_m},
          {left_m, y_m},
          {left_m, y_m + kNicheDepth_m},
          {right_m, y_m + kNicheDepth_m},
          {right_m, y_m},
          {to_m.x(), y_m}};
}

/// The line without what lies near the ends of the corridor.
std::vector<Eigen::Vector2d> Shortened(std::vector<Eigen::Vector2d> line) {
  const Eigen::Vector2d first = (line[1] - line[0]).normalized();
  const Eigen::Vector2d last = (line[line.size() - 2] - line.back()).normalized();
  line.front() += kFromEnds_m * first;
  line.back() += kFromEnds_m * last;
  return line;
}

Route WayAlong(const std::vector<Eigen::Vector2d>& line, const CorridorOptions& options) {
  const double lane_m = options.keeps_right ? 0.25 * options.width_m : 0.0;
  Route route = ToRoute(Shortened(Shifted(line, -lane_m)));
  if (!options.returns) return route;
  const Route back = ToRoute(Shortened(Shifted(line, lane_m)));
  const auto turn = options.keeps_right ? back.rbegin() : back.rbegin() + 1;
  route.insert(route.end(), turn, back.rend());
  return route;
}

}  // namespace

Place MakeCorridor(const CorridorOptions& options) {
  const std::vector<Eigen::Vector2d> line = CentreLine(options);
  if (line.size() < 2) return {};
  const std::vector<Eigen::Vector2d> right = Shifted(line, -0.5 * options.width_m);
  std::vector<Eigen::Vector2d> left = Shifted(line, 0.5 * options.width_m);

  Place place;
  AddWalls(ToRoute({left.front(), right.front()}), kWallThickness_m, place.scenery);
  AddWalls(ToRoute({left.back(), right.back()}), kWallThickness_m, place.scenery);
  AddWalls(ToRoute(right), kWallThickness_m, place.scenery);
  if (options.straight_m > 0.0 && options.door_width_m > 0.0) {
    const Eigen::Vector2d to_m = left.back();
    left.pop_back();
    AddWalls(WallWithDoor(options, left.back(), to_m), kWallThickness_m, place.scenery);
  }
  AddWalls(ToRoute(left), kWallThickness_m, place.scenery);
  place.routes = {WayAlong(line, options)};
  return place;
}

}  // namespace sim
