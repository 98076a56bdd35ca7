// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace qwsm::team {

/// Frame of a component of the team's map: `map` is the one that all share and that has no name,
/// `map_robot2` the one that robot2 has begun.
inline std::string FrameOf(std::string_view component) {
  return component.empty() ? std::string("map") : "map_" + std::string(component);
}

/// The component that has this frame. Of a frame with another name: the one that all share.
inline std::string ComponentOf(std::string_view frame) {
  constexpr std::string_view kPrefix = "map_";
  return std::string(frame.starts_with(kPrefix) ? frame.substr(kPrefix.size()) : "");
}

}  // namespace qwsm::team
