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
#include "service/io/bags/writing/log_bag_writer.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/logs/carmen_writer.hpp"
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

/// Where the records go: a bag, or for these endings a CARMEN log.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& path) {
    const std::filesystem::path ending = path.extension();
    if (ending == ".log" || ending == ".clf") {
      text_ = std::make_unique<io::AtomicFile>(path);
      carmen_ = std::make_unique<io::CarmenWriter>(text_->stream());
    } else {
      bag_ =
          std::make_unique<io::BagFile>(path, io::BagFormatOf(path).value_or(io::BagFormat::kMcap));
      messages_ = std::make_unique<io::LogBagWriter>(*bag_);
    }
  }

  void Write(const io::LogRecord& record) {
    bag_ ? messages_->Write(record) : carmen_->Write(record);
  }
  void ThrowIfFailed() const { bag_ ? bag_->ThrowIfFailed() : text_->ThrowIfFailed(); }
  void Commit() { bag_ ? bag_->Commit() : text_->Commit(); }

 private:
  std::unique_ptr<io::AtomicFile> text_;
  std::unique_ptr<io::CarmenWriter> carmen_;
  std::unique_ptr<io::BagFile> bag_;
  std::unique_ptr<io::LogBagWriter> messages_;
};

ExitCode RunRecord(const RecordArguments& arguments) {
  const NetworkSession session(arguments.network);
  Recording file(arguments.log);
  pipeline::ScanRecorder recorder([&file](const io::LogRecord& record) { file.Write(record); });
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
      "  qwsm record drive                         /scan and /odom, until Ctrl-C: a rosbag2 "
      "folder\n"
      "  qwsm record drive.mcap                    the same as one file; or .db3\n"
      "  qwsm record drive.log                     as CARMEN has it\n"
      "  qwsm record drive.log --robot robot1      /robot1/scan and /robot1/odom");
  parser
      ->add_option("LOG",
                   arguments->log,
                   "where to: a folder, .mcap or .db3, for ROS 2; .log or .clf, CARMEN's format")
      ->required()
      ->type_name("");
  parser->add_option("--robot", arguments->robot, "namespace of the robot; else none")
      ->type_name("NAME");
  parser->add_option("--count", arguments->count, "stop after so many scans")->type_name("N");
  AddNetworkArguments(*parser, arguments->network, {});
  return {.parser = parser, .run = [arguments] { return RunRecord(*arguments); }};
}

}  // namespace qwsm::apps
