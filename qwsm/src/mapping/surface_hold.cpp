// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/surface_hold.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace qwsm {
namespace {

// Points of one straight surface: their normals and their distances from the robot are alike.
constexpr double kAlike_rad = 0.35;
constexpr double kAlike_m = 0.5;
constexpr int kDirections = 12;  // Of half a turn.

using NormalsOfSurface = std::vector<Eigen::Vector2d>;

// What has no normal (a corner, a table leg) is a surface of its own, held from all sides.
std::vector<NormalsOfSurface> SurfacesAmong(std::span<const ScanPoint> points) {
  std::vector<NormalsOfSurface> surfaces;
  std::map<std::pair<long, long>, NormalsOfSurface> straight;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d& normal = point.normal_robot;
    if (normal.isZero()) {
      surfaces.push_back({point.beam_robot});
    } else {
      const long angle = std::lround(std::atan2(normal.y(), normal.x()) / kAlike_rad);
      const long distance = std::lround(normal.dot(point.p_robot_m) / kAlike_m);
      straight[{angle, distance}].push_back(normal);
    }
  }
  for (auto& [key, surface] : straight) surfaces.push_back(std::move(surface));
  return surfaces;
}

// How many points hold along a direction, those of the surface that holds best left out.
double HoldingAlong(const Eigen::Vector2d& direction, std::span<const NormalsOfSurface> surfaces) {
  double all = 0.0;
  double best = 0.0;
  for (const NormalsOfSurface& surface : surfaces) {
    double held = 0.0;
    for (const Eigen::Vector2d& normal : surface) held += std::pow(normal.dot(direction), 2);
    all += held;
    best = std::max(best, held);
  }
  return all - best;
}

}  // namespace

double PointsHoldingWithoutAnySurface(std::span<const ScanPoint> points) {
  const std::vector<NormalsOfSurface> surfaces = SurfacesAmong(points);
  auto fewest = static_cast<double>(points.size());
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = std::numbers::pi * i / kDirections;
    fewest = std::min(fewest, HoldingAlong({std::cos(angle_rad), std::sin(angle_rad)}, surfaces));
  }
  return fewest;
}

}  // namespace qwsm
