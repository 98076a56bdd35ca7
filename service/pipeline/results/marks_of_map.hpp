// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/team/marks/mark.hpp"

namespace qwsm::pipeline {

/// Saves a map with what operators marked on it, of several sources maybe. @throws io::WriteError
void SaveMap(const std::filesystem::path& path,
             const ScanMap& map,
             std::span<const team::Mark> marks);

/// What is marked on a map that was saved. Warns of what is damaged and leaves it out.
/// @throws io::MapFileError
std::vector<team::Mark> MarksOfMap(const std::filesystem::path& path);

}  // namespace qwsm::pipeline
