// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/qwsm.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/program.hpp"

namespace qwsm::apps {

int RunQwsm(int argc, char** argv) {
  const std::unique_ptr<CLI::App> made =
      MakeProgram("Robust weighted scan matching with quadtrees: maps from laser scans.", "qwsm");
  CLI::App& program = *made;
  program.footer(
      "  qwsm map corridor.log.gz            map a recorded log into results/latest\n"
      "  qwsm sim park                       a simulated robot's log, with the truth\n"
      "  qwsm map --help                     all about one command");

  std::vector<Command> commands{AddMapCommand(program),
                                AddLocalizeCommand(program),
                                AddCompareCommand(program),
                                AddEvalCommand(program),
                                AddConvertCommand(program),
                                AddExportCommand(program),
                                AddSimCommand(program),
                                AddExperimentCommand(program),
                                AddServeCommand(program),
                                AddReplayCommand(program),
                                AddEchoCommand(program),
                                AddWatchCommand(program),
                                AddRecordCommand(program)};
  for (Command& command : AddConfigCommands(program)) commands.push_back(std::move(command));
  return static_cast<int>(RunProgram(program, commands, {.count = argc, .values = argv}));
}

}  // namespace qwsm::apps
