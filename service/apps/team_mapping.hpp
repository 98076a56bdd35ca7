// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/run_session.hpp"

namespace qwsm::apps {

/// The robots of one recording, to be mapped together.
struct RecordedTeam {
  std::vector<std::string> robots;  ///< As io::SeveralRobotsError names them.
  /// Maps one robot into the results of a session, and saves its map in a file.
  std::function<ExitCode(
      pipeline::ScanSource&, const RunSession&, const std::filesystem::path& map)>
      map_alone;
  std::optional<std::filesystem::path> save_map;  ///< Where the map of all is kept, too.
};

/// Maps the robots of a recording into one map: the first alone, then each of the others in what is
/// there, wherever it is found in it, extending it. Leaves a folder of results for each robot, and
/// beside them the map of all.
/// @returns kFailed where a robot is found nowhere, which is told.
ExitCode MapTeam(const RunArguments& arguments,
                 const options::ProgramOptions& options,
                 const RecordedTeam& team);

}  // namespace qwsm::apps
