// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/slam6d/slam6d.hpp"

#include <memory>

#include "service/apps/program.hpp"
#include "service/apps/slam6d/commands.hpp"

namespace slam6d::apps {

int RunSlam6d(int argc, char** argv) {
  const std::unique_ptr<CLI::App> made = qwsm::apps::MakeProgram(
      "6D SLAM with cached kd-tree search: one model from many 3D scans.", "slam6d");
  CLI::App& program = *made;
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
  return static_cast<int>(
      qwsm::apps::RunProgram(program, commands, {.count = argc, .values = argv}));
}

}  // namespace slam6d::apps
