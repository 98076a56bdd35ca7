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
  std::optional<Pose2> T_odom_robot;  ///< For the robot to go on from after a restart.
};

/// Places farther from the origin, or longer readings, are an error or an attack: the map would
/// take all memory.
inline constexpr double kMaxDistance_m = 20'000.0;
inline constexpr float kMaxRange_m = 1'000.0F;
inline constexpr std::size_t kMaxBeams = 100'000;

/// Why a scan must not be matched; empty if it may.
std::string_view ObjectionTo(const LaserScan& scan);
/// Why a pose must not be believed; empty if it may.
std::string_view ObjectionTo(const UncertainPose2& pose);
/// Why a scan must not be taken into the map; empty if it may.
std::string_view ObjectionTo(const TeamScan& scan);

}  // namespace qwsm::team
