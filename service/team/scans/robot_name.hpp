// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>

namespace qwsm::team {

/// Most robots of a team; more come from a mistake or an attack.
inline constexpr std::size_t kMaxRobots = 256;

/// Whether a robot, or a component of the map that is named after it, may be called that: what ROS
/// accepts as a namespace, without slashes around it. Names become topics of ours and folders:
/// nothing else must get through.
bool IsRobotName(std::string_view name);

}  // namespace qwsm::team
