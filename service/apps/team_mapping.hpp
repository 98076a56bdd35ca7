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

/// Maps the robots of a recording into one map: each alone, whatever moves as a robot does left
/// out. Maps are joined where all that two of them show says that they go together, and in the end
/// map and paths of all are corrected by one graph. Leaves a folder of results for each robot, and
/// beside them the map of all; a robot that is found nowhere has its results in a map of its own.
/// @returns kFailed where a robot is found nowhere, which is told.
ExitCode MapTeam(const RunArguments& arguments,
                 const options::ProgramOptions& options,
                 const RecordedTeam& team);

}  // namespace qwsm::apps
