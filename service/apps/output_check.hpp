// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

namespace qwsm::apps {

/// Refuses an output that would replace an input, by whatever names and links they go.
/// @param output a file, or a folder that a bag is written into; "-" replaces nothing.
/// @throws io::WriteError naming both.
void RefuseToReplace(const std::filesystem::path& output,
                     std::span<const std::filesystem::path> inputs);

/// Refuses a place for a map that would replace a log or anything that is no map, or that cannot be
/// written to.
/// @param results the folder of the run's results, which may have to be created yet.
/// @throws io::WriteError
void CheckMapToSave(const std::filesystem::path& map,
                    std::span<const std::filesystem::path> logs,
                    const std::filesystem::path& results);

}  // namespace qwsm::apps
