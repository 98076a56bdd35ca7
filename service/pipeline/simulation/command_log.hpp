// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "sim/scenario.hpp"

namespace qwsm::pipeline {

/// The commands of a recorded drive: text with a line per command, `stamp forward turn` in seconds,
/// m/s and rad/s, separated by blanks or commas. The drive begins with the first line; `#` begins a
/// comment.
/// @throws config::ConfigError naming every line that is wrong.
std::vector<sim::TimedCommandOptions> ReadCommandLog(const std::filesystem::path& file);

/// Puts the commands into the scenario of all drivers that name a log, which are then found
/// relative to `folder`, and takes the names out: what is left needs no other file.
/// @throws config::ConfigError naming everything wrong with any of the logs.
void ReadCommandLogs(const std::filesystem::path& folder, sim::ScenarioOptions& scenario);

}  // namespace qwsm::pipeline
