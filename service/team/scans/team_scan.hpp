// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/team/scans/scan_key.hpp"

namespace qwsm::team {

/// How a robot came from its last relevant scan to the next.
struct ScanMotion {
  UncertainPose2 odometry;  ///< As odometry tells it, as uncertain as it has proved to be.
  /// As it is believed (`ScanNode::T_last_node`); none where the answer does not continue the one
  /// before.
  std::optional<Pose2> T_last_this;
};

/// A relevant scan of any robot of the team: from these alone the map can be rebuilt.
struct TeamScan {
  ScanKey key;
  /// In which component of the team's map it was taken; empty for the one that all share. Since
  /// then it may have been moved into another one.
  std::string component{};
  LaserScan scan{};
  UncertainPose2 map_robot{};           ///< In the component that it is in.
  std::optional<Pose2> T_odom_robot{};  ///< Odometry for the robot to go on from after a restart.
  /// Whether nobody knows how the robot came here from its last relevant scan.
  bool is_new_start = false;
  std::optional<ScanMotion> motion{};  ///< Known where the scan was matched, for a while.
};

/// Says why a scan must not be taken into the map; empty if it may.
std::string_view ObjectionTo(const TeamScan& scan);

}  // namespace qwsm::team
