// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm::team {

/// Where a map lies in another one.
struct MeetingPlace {
  std::size_t map = 0;  ///< Which one of them.
  UncertainPose2 first_map;
};

/// Maps that are one.
struct MetMaps {
  /// Their places, that of the first one first, in the order in which they were found: each by
  /// those before.
  std::vector<MeetingPlace> places;
  ScanMap map;  ///< The scans of all, in that order.
};

/// Finds where maps that robots made, each alone, lie in that of the first one, or of the first of
/// whom anything is mapped: where each may be by what its scans look like in the others' maps, and
/// is by all that both have mapped. What a place has for it counts no more than the building
/// repeats itself; against it is what robots saw at the same time, who would have been in view of
/// each other and were not. The one for which most speaks gets its place first. Maps that are found
/// in none but each other have no place in the first's.
/// @param stop asked before each look; when true, it is left at what was found.
MetMaps FindMeetingPlaces(
    std::span<const ScanMap* const> maps,
    const MapperOptions& options,
    const std::function<bool()>& stop = [] { return false; });

}  // namespace qwsm::team
