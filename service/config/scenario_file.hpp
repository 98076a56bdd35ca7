// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace qwsm::config {

/// Path of a scenario's file, given by path or, for a shipped one, by name: `park`. Shipped files
/// are looked for beside the program (../share/qwsm/scenarios) and, for a program in its build
/// folder, in the source tree. What looks like a path is returned as it is.
/// @throws ConfigError if a name is neither; it tells the names there are.
std::filesystem::path FindScenario(const std::string& path_or_name);

}  // namespace qwsm::config
