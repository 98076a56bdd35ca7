// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/localizer.hpp"
#include "service/apps/run_session.hpp"
#include "service/pipeline/results/journal_marks.hpp"

namespace qwsm::apps {

/// A map that was made before, with what operators marked on it.
struct KnownMap {
  ScanMap map;
  std::vector<team::Mark> marks{};
};

/// The map of a file: one that was saved, or the occupancy grid of another program.
/// @throws UsageError where there is nothing in it to localize by.
KnownMap OpenMap(const std::filesystem::path& path);

/// A robot in such a map, and the marks on it.
struct RobotInMap {
  Localizer& localizer;
  pipeline::JournalMarks& marks;
};

/// Whether a file is an occupancy grid of another program, by its name.
bool IsGrid(const std::filesystem::path& path);

/// Follows a robot through a map that was made before, and leaves the results.
/// @param task as `localize`, for messages.
/// @returns kFailed where the log ends and the robot is lost, which is told.
ExitCode FollowInMap(const std::string& task,
                     const RobotInMap& robot,
                     pipeline::ScanSource& source,
                     const options::ProgramOptions& options,
                     const RunSession& session);

/// How a drive ended that went on with a map, and what the map of both is of.
struct ContinuedMap {
  ExitCode code = ExitCode::kDone;
  std::vector<RelevantScan> scans;
  std::vector<team::Mark> marks{};
};

/// As FollowInMap() for `map`, then corrects the map that was made before and the drive together.
/// @param robot with the marks of the log alone. @param marks_before of the map.
ContinuedMap CorrectAfterFollowing(const RobotInMap& robot,
                                   const std::vector<team::Mark>& marks_before,
                                   pipeline::ScanSource& source,
                                   const options::ProgramOptions& options,
                                   const RunSession& session);

}  // namespace qwsm::apps
