// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "service/team/map/team_maps.hpp"
#include "service/team/scans/team_epoch.hpp"

namespace qwsm::team {

/// Where a scan belongs.
struct Placement {
  std::string component;
  UncertainPose2 map_robot;
};

using Placements = std::unordered_map<ScanKey, Placement, ScanKeyHash>;

/// Where all scans of a team belong.
struct Rearrangement {
  std::map<std::string, std::vector<Placement>> wanted;  ///< By component now, and ScanId.
  /// Whether scans of which nothing was told are moved with those that were.
  bool moves_others = false;
};

/// All scans where they are.
Rearrangement AsTheyAre(const TeamMaps& maps);

/// Puts scans where they were told to be. Those of which nothing was told keep their place beside
/// the last one of their robot that was.
Rearrangement Follow(const TeamMaps& maps, const Placements& told);

/// The epoch that makes it so.
TeamEpoch EpochOf(const TeamMaps& maps, const Rearrangement& wanted, const EpochRank& rank);

}  // namespace qwsm::team
