// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// A map, and who drew it.
struct DrawnMap {
  const ScanMap& map;
  /// Of each robot the scans that it took, in the order of time.
  std::span<const std::vector<ScanId>> scans_of_robots;
};

/// Whether a scan tells that nobody stands at a place: the robot stands there itself, or sees what
/// lies behind. Where something hides the place, or beams are too far from each other, it does not.
bool SeesNobodyAt(const LaserScan& scan, const Eigen::Vector2d& p_robot_m);

/// How often, were two maps one, a robot of one would have had one of the other in view, and saw
/// nobody there. Asks all scans that both maps were drawn by.
/// @param at_most counts no further.
int CountUnseen(const DrawnMap& a, const DrawnMap& b, const Pose2& T_a_b, int at_most);

}  // namespace qwsm::team
