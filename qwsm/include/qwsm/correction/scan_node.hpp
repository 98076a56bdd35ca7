// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// A relevant scan as a node of the pose graph.
struct ScanNode {
  LaserScan scan;            ///< The scan without the beams that ended on what moves.
  UncertainPose2 map_robot;  ///< Pose in the map as it is: as answered, or as corrected since.
  UncertainPose2 odometry;   ///< Motion since the robot's node before, as odometry tells it.
  /// The same motion as it is believed, as answered or, where odometry adds up, as that tells; none
  /// where the answer does not continue the one before.
  std::optional<Pose2> T_last_node;
  std::size_t robot = 0;  ///< Which robot took it, where several make one map.
};

}  // namespace qwsm
