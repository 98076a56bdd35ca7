// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/graph/pose_graph.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// Where a robot was found that came into the map.
struct FoundBeside {
  NodeId node = 0;            ///< One near there, which stands for those whose surfaces it saw.
  UncertainPose2 node_robot;  ///< Pose of the robot as seen from it.
};

/// A relevant scan as a node of the pose graph.
struct ScanNode {
  LaserScan scan;            ///< The scan without the beams that ended on what moves.
  UncertainPose2 map_robot;  ///< Pose in the map as it is: as answered, or as corrected since.
  UncertainPose2 odometry;   ///< Motion since the robot's node before, as odometry tells it.
  /// The same motion as it is believed, as answered or, where odometry adds up, as that tells; none
  /// where the answer does not continue the one before.
  std::optional<Pose2> T_last_node;
  std::size_t robot = 0;  ///< Which robot took it, where several make one map.
  /// Of the first node of a robot that was found by what it saw; else its pose in the map counts.
  std::optional<FoundBeside> found = {};
};

}  // namespace qwsm
