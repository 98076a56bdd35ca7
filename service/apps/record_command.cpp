// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/network.hpp"
#include "service/apps/number_arguments.hpp"
#include "service/apps/output.hpp"
#include "service/dds/robot/robot_feed.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "service/pipeline/network/bag_recorder.hpp"
#include "service/pipeline/network/scan_recorder.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

using namespace std::chrono_literals;

struct RecordArguments {
  std::filesystem::path recording;
  std::string robot;
  std::optional<std::size_t> count;
  NetworkArguments network;
};

/// Whether a name asks for a CARMEN log; others are those of bags.
bool IsLog(const std::filesystem::path& path) {
  const std::filesystem::path ending = path.extension();
  return ending == ".log" || ending == ".clf";
}

bool IsEnough(const RecordArguments& arguments, std::size_t scans) {
  return arguments.count && scans >= *arguments.count;
}

/// Records, and tells where what was recorded is if that cannot go on.
void RecordKeeping(const std::filesystem::path& unfinished, const std::function<void()>& record) {
  try {
    record();
  } catch (const io::WriteError& error) {
    throw io::WriteError(
        fmt::format("{}; what was recorded before is in {}", error.what(), unfinished.string()));
  }
}

/// Everything that is said, as it is said.
std::string RecordBag(const RecordArguments& arguments, const dds::Participant& participant) {
  io::BagFile bag(arguments.recording,
                  io::BagFormatOf(arguments.recording).value_or(io::BagFormat::kMcap));
  pipeline::BagRecorder recorder(participant,
                                 arguments.robot,
                                 bag,
                                 {.info = [](const std::string& text) { messages::Info(text); },
                                  .warn = [](const std::string& text) { messages::Warn(text); }});
  const pipeline::Interruption interruption;
  messages::Info("recording");
  RecordKeeping(bag.KeepUnfinished(), [&] {
    while (!interruption.requested() && !IsEnough(arguments, recorder.scans())) {
      recorder.Record(100ms);
    }
    bag.Commit();
  });
  return fmt::format("{} messages of {} topics, {} of them scans",
                     recorder.messages(),
                     recorder.topics(),
                     recorder.scans());
}

/// The scans of one robot, each with its odometry.
std::string RecordLog(const RecordArguments& arguments,
                      const dds::Participant& participant,
                      const std::vector<std::string>& scan_topics) {
  io::AtomicFile file(arguments.recording);
  io::CarmenWriter log(file.stream());
  pipeline::ScanRecorder recorder([&log](const io::LogRecord& record) { log.Write(record); });
  dds::Refusals refusals([](const std::string& text) { messages::Warn(text); });
  const dds::RobotNames names(arguments.robot);
  dds::RobotFeed feed(participant, names, scan_topics, refusals);
  const pipeline::Interruption interruption;
  for (const std::string& topic : scan_topics) messages::Info("recording {}", names.Topic(topic));
  RecordKeeping(file.KeepUnfinished(), [&] {
    while (!interruption.requested() && !IsEnough(arguments, recorder.scans())) {
      feed.Deliver(100ms, recorder);
      recorder.WriteReady();
      file.ThrowIfFailed();
    }
    recorder.Finish();
    file.Commit();
  });
  return fmt::format("{} scans", recorder.scans());
}

ExitCode RunRecord(const RecordArguments& arguments) {
  const NetworkSession session(arguments.network);
  const dds::Participant participant(session.options().network);
  const std::string recorded =
      IsLog(arguments.recording)
          ? RecordLog(arguments, participant, team::ScanTopicsOf(session.options().team))
          : RecordBag(arguments, participant);
  if (!arguments.network.verbosity.quiet) {
    Print("recorded       {} in {}\n", recorded, arguments.recording.string());
  }
  return ExitCode::kDone;
}

}  // namespace

Command AddRecordCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "record", "what is said on the network, as a bag or a log");
  auto arguments = std::make_shared<RecordArguments>();
  parser->footer(
      "  qwsm record drive                     all topics, until Ctrl-C: a folder of rosbag2\n"
      "  qwsm record drive.mcap                the same as one file; or .db3\n"
      "  qwsm record drive --robot robot1      /robot1/..., /tf and /tf_static\n"
      "  qwsm record drive.log                 scans of /scan with their odometry, for CARMEN;\n"
      "                                        of several lasers' topics: --set "
      "team.scans=scan,rear/scan");
  parser
      ->add_option("RECORDING",
                   arguments->recording,
                   "where to: a folder, .mcap or .db3, for ROS 2; .log or .clf, CARMEN's format")
      ->required()
      ->type_name("");
  parser
      ->add_option("--robot",
                   arguments->robot,
                   "only what this robot says; of a log, else that without a namespace")
      ->type_name("NAME");
  parser->add_option("--count", arguments->count, "stop after so many scans")
      ->check(NumberBetween(1.0, kMostCounted))
      ->type_name("N");
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunRecord(*arguments); }};
}

}  // namespace qwsm::apps
