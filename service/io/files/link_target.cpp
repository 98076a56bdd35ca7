// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/files/link_target.hpp"

#include <system_error>

namespace qwsm::io {

std::filesystem::path TargetOf(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // As the system has it.
  std::error_code is_no_link;
  for (int links = 0; links < kMostLinks; ++links) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, is_no_link);
    if (is_no_link) break;
    path = path.parent_path() / target;
  }
  return path;
}

}  // namespace qwsm::io
