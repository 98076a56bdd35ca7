// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// Where the robot was at a moment.
struct StampedPose2 {
  Timestamp stamp{};
  Pose2 T_map_robot;

  friend bool operator==(const StampedPose2&, const StampedPose2&) = default;
};

/// Poses in the order in which they were estimated; stamps may step back or repeat.
using Trajectory = std::vector<StampedPose2>;

}  // namespace qwsm
