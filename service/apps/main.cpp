// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <utility>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/program.hpp"

namespace qwsm::apps {
namespace {

ExitCode Run(const Arguments& arguments) {
  CLI::App program("Robust weighted scan matching with quadtrees: maps from laser scans.", "qwsm");
  PrepareProgram(program);
  program.footer(
      "  qwsm map corridor.log.gz            map a recorded log into results/latest\n"
      "  qwsm sim park                       a simulated robot's log, with the truth\n"
      "  qwsm map --help                     all about one command");

  std::vector<Command> commands{AddMapCommand(program),
                                AddLocalizeCommand(program),
                                AddCompareCommand(program),
                                AddEvalCommand(program),
                                AddConvertCommand(program),
                                AddSimCommand(program),
                                AddExperimentCommand(program),
                                AddServeCommand(program),
                                AddReplayCommand(program),
                                AddEchoCommand(program),
                                AddWatchCommand(program),
                                AddRecordCommand(program)};
  for (Command& command : AddConfigCommands(program)) commands.push_back(std::move(command));
  return RunProgram(program, commands, arguments);
}

}  // namespace
}  // namespace qwsm::apps

int main(int argc, char** argv) {
  return static_cast<int>(qwsm::apps::Run({.count = argc, .values = argv}));
}
