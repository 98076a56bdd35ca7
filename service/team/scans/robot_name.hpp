// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace qwsm::team {

/// Whether a robot, or a component of the map that is named after it, may be called that: what ROS
/// accepts as a namespace, without slashes around it. Names become topics of ours and folders:
/// nothing else must get through.
bool IsRobotName(std::string_view name);

}  // namespace qwsm::team
