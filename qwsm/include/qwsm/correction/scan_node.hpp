// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// A relevant scan as a node of the pose graph.
struct ScanNode {
  LaserScan scan;            ///< The scan without the beams that ended on what moves.
  UncertainPose2 map_robot;  ///< Pose as it was answered.
  UncertainPose2 odometry;   ///< Motion since the node before, as odometry tells it.
  bool closed_loop = false;  ///< Whether the answer does not continue the one before.
};

}  // namespace qwsm
