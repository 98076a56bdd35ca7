// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <memory>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/replay_arguments.hpp"
#include "service/pipeline/run/log_source.hpp"

namespace qwsm::apps {
namespace {

struct LogReplayArguments {
  std::vector<std::filesystem::path> logs;
  ReplayArguments replay;
  NetworkArguments network;
};

ExitCode RunReplay(const LogReplayArguments& arguments) {
  const NetworkSession session(arguments.network);
  const Verbosity& verbosity = arguments.network.verbosity;
  ReplayOptionsOf(arguments.replay, verbosity);  // Wrong ones are told before a log is read.
  io::LogOptions log = LogOptionsOf(session.options().log);
  if (log.robot.empty()) log.robot = arguments.replay.robot;
  log.as_measured = true;
  pipeline::LogSource source(arguments.logs, log);
  if (source.Peek() == nullptr) {
    throw UsageError("there is no scan in " + arguments.logs.front().string());
  }
  return Replay<team::Planar>(
      source, arguments.replay, session.options().network, verbosity, "qwsm serve");
}

}  // namespace

Command AddReplayCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "replay", "a recorded log as a robot on the network");
  auto arguments = std::make_shared<LogReplayArguments>();
  parser->footer(
      "  qwsm replay intel.log.gz                   as /scan and /odom, at its own pace\n"
      "  qwsm replay intel.log.gz --robot robot1    as /robot1/scan and /robot1/odom\n"
      "  qwsm replay intel.log.gz --rate 10         ten times as fast\n"
      "  qwsm replay intel.log.gz --rate max        as fast as the service answers");
  parser
      ->add_option(
          "LOG", arguments->logs, "logs or bags, parts of one recording; - is standard input")
      ->required()
      ->type_name("");
  AddTopics(*parser, arguments->network.sources);
  AddReplayArguments(*parser, arguments->replay);
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunReplay(*arguments); }};
}

}  // namespace qwsm::apps
