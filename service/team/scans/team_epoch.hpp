// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/team/scans/scan_key.hpp"

namespace qwsm::team {

/// A relevant scan that was put where it belongs.
struct MovedScan {
  ScanKey key;
  Pose2 T_map_robot_before;
  UncertainPose2 map_robot;
};

/// Which of two corrections of one map counts, wherever they were found: the greater.
struct EpochRank {
  std::uint64_t number = 0;  ///< Grows with the corrections of the map.
  std::string service;       ///< Service that found it.

  friend auto operator<=>(const EpochRank&, const EpochRank&) = default;
};

/// A correction of a map, all of which takes effect at once.
struct TeamEpoch {
  EpochRank rank;
  std::string robot;  ///< Whose map it is; empty for the team's.
  Timestamp stamp{};  ///< Of the newest scan in the map.
  std::vector<MovedScan> scans;
};

}  // namespace qwsm::team
