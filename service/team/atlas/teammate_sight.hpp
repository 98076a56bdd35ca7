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

/// What a scan tells of a place.
enum class Sight {
  kNothing,   ///< Something hides it, a wall is there, or beams are too far from each other.
  kNobody,    ///< The robot stands there itself, or sees what lies behind.
  kSomebody,  ///< Something is there, or was and has been hidden, and beams pass by on both sides.
};

Sight LookAt(const LaserScan& scan, const Eigen::Vector2d& p_robot_m);

struct SightCounts {
  int somebody = 0;
  int nobody = 0;

  friend bool operator==(const SightCounts&, const SightCounts&) = default;
};

/// What robots of one map saw where those of the other were, were the two maps one. Asks all scans
/// that both maps were drawn by.
/// @param at_most_nobody counts no further once so many scans saw nobody.
SightCounts CountSights(const DrawnMap& a,
                        const DrawnMap& b,
                        const Pose2& T_a_b,
                        int at_most_nobody);

}  // namespace qwsm::team
