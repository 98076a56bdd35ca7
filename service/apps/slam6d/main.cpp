// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/program.hpp"
#include "service/apps/slam6d/commands.hpp"

namespace slam6d::apps {
namespace {

ExitCode Run(const qwsm::apps::Arguments& arguments) {
  CLI::App program("6D SLAM with cached kd-tree search: one model from many 3D scans.", "slam6d");
  qwsm::apps::PrepareProgram(program);
  program.footer(
      "  slam6d register courtyard/                 a folder of scans, into results/latest\n"
      "  slam6d eval results/latest --truth gt/     how good that is\n"
      "  slam6d register --help                     all about one command");
  const std::vector<Command> commands{AddRegisterCommand(program),
                                      AddEvalCommand(program),
                                      AddSimCommand(program),
                                      AddServeCommand(program),
                                      AddReplayCommand(program),
                                      AddBenchSearchCommand(program),
                                      AddConfigCommand(program)};
  return qwsm::apps::RunProgram(program, commands, arguments);
}

}  // namespace
}  // namespace slam6d::apps

int main(int argc, char** argv) {
  return static_cast<int>(slam6d::apps::Run({.count = argc, .values = argv}));
}
