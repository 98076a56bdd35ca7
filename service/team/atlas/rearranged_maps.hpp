// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "service/team/atlas/rearrangement.hpp"
#include "service/team/map/team_maps.hpp"

namespace qwsm::team {

/// The maps of a team as a rearrangement wants them, made while robots are answered in the old ones
/// and extend these. A component that nothing happens to keeps its map, one that only gets scans
/// goes on in a copy, with these behind its own, one whose scans only move goes on in the map's
/// next version, and any other is made anew.
class RearrangedMaps {
 public:
  /// Puts scans where they are wanted: all of them the first time, and then what came since.
  /// @param maps of those scans, and perhaps more. @pre nothing in them was moved since the first
  /// time.
  void Follow(const TeamMaps& maps, const Rearrangement& rearrangement);

  /// The maps of the components to which something happens; none where all scans are gone.
  std::map<std::string, std::shared_ptr<TeamMap>> maps() const;

 private:
  enum class Fate { kGrows, kIsCorrected, kIsMadeAnew };
  using Fates = std::map<std::string, Fate>;  // By component, but for those that stay as they are.

  static Fates FatesOf(const TeamMaps& maps, const Rearrangement& rearrangement);
  void Begin(const TeamMaps& maps, Fates fates);

  Fates fates_;
  std::map<std::string, std::shared_ptr<TeamMap>> made_;
  std::map<std::string, std::size_t> placed_;  // Number of scans, by the component they were in.
};

}  // namespace qwsm::team
