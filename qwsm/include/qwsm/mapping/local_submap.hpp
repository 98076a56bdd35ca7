// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

struct LocalSubmapOptions {
  int count = 8;
  int points = 150;
  double spacing_m = 0.4;
};

template <class Visitor>
void Describe(Visitor& visit, LocalSubmapOptions& o) {
  visit("count",
        o.count,
        {.help = "relevant scans of a laser that make up the submap", .min = 1, .max = 100});
  visit("points",
        o.points,
        {.help = "more scans than these, where they show less than so many points",
         .min = 0,
         .max = 100000});
  visit("spacing_m",
        o.spacing_m,
        {.help = "one point per cell of this size", .min = 0.01, .max = 10});
}

/// The local submap: the last few relevant scans of a laser, and what others saw meanwhile. One
/// scan in a corridor resembles many places, the last ten metres do not. Where little is in view,
/// more scans are kept.
class LocalSubmap {
 public:
  explicit LocalSubmap(const LocalSubmapOptions& options = {}) : options_(options) {}

  /// @param T_robot_laser tells lasers apart.
  void Add(const Pose2& T_map_robot,
           std::span<const ScanPoint> points,
           const Pose2& T_robot_laser = {});
  void Clear();
  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

  /// Their points as the robot sees them now, at most one per cell.
  std::vector<ScanPoint> PointsAround(const Pose2& T_map_robot) const;

 private:
  struct Scan {
    Pose2 T_map_robot;
    Pose2 T_robot_laser;
    std::vector<ScanPoint> points;  // Thinned.
  };

  LocalSubmapOptions options_;
  std::deque<Scan> scans_;  // The latest last.
  std::size_t points_ = 0;  // Of all of them.
};

}  // namespace qwsm
