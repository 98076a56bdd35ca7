// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace qwsm::io {

/// The file that a path leads to by symbolic links, whether there is one yet or not.
std::filesystem::path TargetOf(std::filesystem::path path);

}  // namespace qwsm::io
