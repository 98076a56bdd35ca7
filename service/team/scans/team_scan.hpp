// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/team/scans/scan_key.hpp"

namespace qwsm::team {

/// A relevant scan of any robot of the team: from these alone the map can be rebuilt.
struct TeamScan {
  ScanKey key;
  LaserScan scan;
  UncertainPose2 map_robot;
  std::optional<Pose2> T_odom_robot;  ///< Odometry for the robot to go on from after a restart.
};

/// Says why a scan must not be taken into the map; empty if it may.
std::string_view ObjectionTo(const TeamScan& scan);

}  // namespace qwsm::team
