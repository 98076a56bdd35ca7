// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace qwsm::team {

/// Says which robots match against which map.
enum class MapSharing {
  kTeam,       ///< All robots match against one map.
  kEachRobot,  ///< Each robot matches against its own map.
};

inline std::span<const std::pair<std::string_view, MapSharing>> Names(MapSharing) {
  static constexpr std::array<std::pair<std::string_view, MapSharing>, 2> kNames = {{
      {"team", MapSharing::kTeam},
      {"each-robot", MapSharing::kEachRobot},
  }};
  return kNames;
}

}  // namespace qwsm::team
