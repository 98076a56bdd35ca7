// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <span>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm::team {

/// A robot moves no farther in this time than its body is long.
inline constexpr std::chrono::milliseconds kSameTime{300};

/// What a robot sees, and where it is in its map.
struct RobotSight {
  std::span<const ScanPoint> points;
  Pose2 T_map_robot;
};

/// Whether a robot sees that nobody stands at a place: it stands there itself, or sees what lies
/// behind. Where something hides the place, or beams are too far from each other, it does not.
bool SeesNobodyAt(std::span<const ScanPoint> points, const Eigen::Vector2d& p_robot_m);

}  // namespace qwsm::team
