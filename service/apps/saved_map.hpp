// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "qwsm/mapping/localizer.hpp"
#include "service/apps/run_session.hpp"

namespace qwsm::apps {

/// The map of a file: one that was saved, or the occupancy grid of another program.
/// @throws UsageError where there is nothing in it to localize by.
ScanMap OpenMap(const std::filesystem::path& path);

/// Whether a file is an occupancy grid of another program, by its name.
bool IsGrid(const std::filesystem::path& path);

/// Follows a robot through a map that was made before, and leaves the results.
/// @param task as `localize`, for messages.
/// @returns kFailed where the log ends and the robot is lost, which is told.
ExitCode FollowInMap(const std::string& task,
                     Localizer& localizer,
                     pipeline::ScanSource& source,
                     const options::ProgramOptions& options,
                     const RunSession& session);

/// How a drive ended that went on with a map, and the map of both.
struct ContinuedMap {
  ExitCode code = ExitCode::kDone;
  ScanMap map;
};

/// As FollowInMap() for `map`, then corrects the map that was made before and the drive together.
ContinuedMap CorrectAfterFollowing(Localizer& localizer,
                                   pipeline::ScanSource& source,
                                   const options::ProgramOptions& options,
                                   const RunSession& session);

}  // namespace qwsm::apps
