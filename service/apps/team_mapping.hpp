// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/run_session.hpp"

namespace qwsm::apps {

/// The robots of one recording, to be mapped together.
struct RecordedTeam {
  std::vector<std::string> robots;                ///< As io::SeveralRobotsError names them.
  std::optional<std::filesystem::path> save_map;  ///< Where the map of all is kept, too.
};

/// Maps the robots of a recording into one map: each first alone, which tells where their maps go
/// together and so where each robot starts in that of the first one; then each of the others in
/// what is there, extending it. In the end map and paths of all are corrected by one graph. Leaves
/// a folder of results for each robot, and beside them the map of all.
/// @returns kFailed where a robot is found nowhere, or is lost in the end, which is told.
ExitCode MapTeam(const RunArguments& arguments,
                 const options::ProgramOptions& options,
                 const RecordedTeam& team);

}  // namespace qwsm::apps
