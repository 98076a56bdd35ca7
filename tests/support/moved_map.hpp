// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <utility>

#include "service/team/scans/team_epoch.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::test {

/// A correction that moves all of these scans alike.
/// @param T_map_moved applied in the frame of the map.
inline team::TeamEpoch Moved(std::span<const team::TeamScan> scans,
                             const Pose2& T_map_moved,
                             team::EpochRank rank) {
  team::TeamEpoch epoch{.rank = std::move(rank), .stamp = {}, .scans = {}};
  for (const team::TeamScan& scan : scans) {
    team::MovedScan& moved = epoch.scans.emplace_back();
    moved = {
        .key = scan.key, .T_map_robot_before = scan.map_robot.T_a_b, .map_robot = scan.map_robot};
    moved.map_robot.T_a_b = T_map_moved * scan.map_robot.T_a_b;
  }
  return epoch;
}

}  // namespace qwsm::test
