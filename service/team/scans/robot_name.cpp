// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/robot_name.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace qwsm::team {

bool IsRobotName(std::string_view name) {
  constexpr std::size_t kMaxLength = 128;
  const auto is_legal = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '/';
  };
  return name.size() <= kMaxLength && std::ranges::all_of(name, is_legal) &&
         !name.starts_with('/') && !name.ends_with('/') && name.find("//") == name.npos;
}

}  // namespace qwsm::team
