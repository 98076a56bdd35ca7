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

/// A relevant scan, where it belongs.
struct MovedScan {
  ScanKey key;
  std::string component{};         ///< Of the team's map, that the scan is in now.
  std::string component_before{};  ///< That it was in before.
  Pose2 T_map_robot_before{};      ///< In that one.
  UncertainPose2 map_robot{};
};

/// Corrections are numbered below: one each second for a hundred years.
inline constexpr std::uint64_t kMostEpochs = 1ULL << 32U;

/// Which of two corrections counts, wherever they were found: the greater.
struct EpochRank {
  std::uint64_t number = 0;  ///< Grows with the corrections.
  std::string service;       ///< Service that found it.

  friend auto operator<=>(const EpochRank&, const EpochRank&) = default;
};

/// A correction of a team's maps, all of which takes effect at once: scans are put elsewhere, and
/// components that are found to lie in one another become one.
struct TeamEpoch {
  EpochRank rank;
  Timestamp stamp{};             ///< Of the newest scan.
  std::vector<MovedScan> scans;  ///< All that there are.
};

}  // namespace qwsm::team
