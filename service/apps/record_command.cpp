// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/output.hpp"
#include "service/dds/robot/robot_feed.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/network/scan_recorder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;

struct RecordArguments {
  std::filesystem::path log;
  std::string robot;
  std::optional<std::size_t> count;
  NetworkArguments network;
};

ExitCode RunRecord(const RecordArguments& arguments) {
  const NetworkSession session(arguments.network);
  io::AtomicFile file(arguments.log);
  pipeline::ScanRecorder recorder(file.stream());
  dds::Refusals refusals([](const std::string& text) { messages::Warn(text); });
  const dds::Participant participant(session.options().network);
  dds::RobotFeed feed(participant, dds::RobotNames(arguments.robot), refusals);
  const pipeline::Interruption interruption;
  messages::Info("recording {}", dds::RobotNames(arguments.robot).Topic(dds::kScanTopic));
  while (!interruption.requested() && !(arguments.count && recorder.scans() >= *arguments.count)) {
    feed.Deliver(100ms, recorder);
    recorder.WriteReady();
    file.ThrowIfFailed();
  }
  recorder.Finish();
  file.Commit();
  if (!arguments.network.verbosity.quiet) {
    Print("recorded       {} scans in {}\n", recorder.scans(), arguments.log.string());
  }
  return ExitCode::kDone;
}

}  // namespace

Command AddRecordCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "record", "what a robot on the network says, as a log");
  auto arguments = std::make_shared<RecordArguments>();
  parser->footer(
      "  qwsm record drive.log                     /scan and /odom, until Ctrl-C\n"
      "  qwsm record drive.log --robot robot1      /robot1/scan and /robot1/odom");
  parser->add_option("LOG", arguments->log, "where to; CARMEN's format")->required()->type_name("");
  parser->add_option("--robot", arguments->robot, "namespace of the robot; else none")
      ->type_name("NAME");
  parser->add_option("--count", arguments->count, "stop after so many scans")->type_name("N");
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunRecord(*arguments); }};
}

}  // namespace qwsm::apps
