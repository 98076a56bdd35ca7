// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace qwsm::team {

/// Whether a robot can have that name, as far as ROS accepts it for a namespace, without slashes
/// around it. Names become topics of ours and folders: nothing else must get through.
inline bool IsRobotName(std::string_view name) {
  constexpr std::size_t kLongest = 128;
  const auto is_legal = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '/';
  };
  return name.size() <= kLongest && std::ranges::all_of(name, is_legal) && !name.starts_with('/') &&
         !name.ends_with('/') && name.find("//") == name.npos;
}

}  // namespace qwsm::team
