// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/standard_output.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "service/io/trajectories/trajectory_file.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::vector<fs::path> logs;
  fs::path output = "-";
  std::string format = "carmen";
  Verbosity verbosity;
  config::OptionSources sources;
};

/// Takes the records of a log and leaves them in another form.
using RecordWriter = std::function<void(const io::LogRecord&)>;

RecordWriter CarmenRecords(std::ostream& stream, io::CarmenDialect dialect) {
  auto writer = std::make_shared<io::CarmenWriter>(stream, dialect);
  return [writer](const io::LogRecord& record) { writer->Write(record); };
}

RecordWriter OdometryAtScans(std::ostream& stream) {
  return [&stream](const io::LogRecord& record) {
    const auto* scan = std::get_if<io::ScanReading>(&record);
    if (scan == nullptr || !scan->T_odom_robot) return;
    io::WriteTumLine(stream, {.stamp = scan->scan.stamp, .T_map_robot = *scan->T_odom_robot});
  };
}

RecordWriter TruePoses(std::ostream& stream) {
  return [&stream](const io::LogRecord& record) {
    const auto* truth = std::get_if<io::TruePoseReading>(&record);
    if (truth == nullptr) return;
    io::WriteTumLine(stream, {.stamp = truth->stamp, .T_map_robot = truth->T_world_robot});
  };
}

RecordWriter MakeWriter(const std::string& format, std::ostream& stream) {
  if (format == "carmen") return CarmenRecords(stream, io::CarmenDialect::kRobotLaser);
  if (format == "carmen-flaser") return CarmenRecords(stream, io::CarmenDialect::kFlaser);
  if (format == "odometry") return OdometryAtScans(stream);
  return TruePoses(stream);
}

void Convert(const ConvertArguments& arguments, std::ostream& stream) {
  const auto options = config::LoadOptions<options::ProgramOptions>(arguments.sources);
  const RecordWriter write = MakeWriter(arguments.format, stream);
  for (const fs::path& log : arguments.logs) {
    const std::unique_ptr<io::LogReader> reader = io::OpenLog(log, LogOptionsOf(options.log));
    while (const std::optional<io::LogRecord> record = reader->Next()) {
      write(*record);
      if (stream) continue;
      if (arguments.output == "-") throw io::StandardOutputError();
      throw io::WriteError(arguments.output.string() + ": cannot be written");
    }
  }
}

ExitCode RunConvert(const ConvertArguments& arguments) {
  StartMessages(arguments.verbosity);
  if (arguments.output == "-") {
    Convert(arguments, std::cout);
    if (!std::cout.flush()) throw io::StandardOutputError();
    return ExitCode::kDone;
  }
  io::AtomicFile file(arguments.output);
  Convert(arguments, file.stream());
  file.Commit();
  return ExitCode::kDone;
}

}  // namespace

Command AddConvertCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "convert", "logs into other forms");
  auto arguments = std::make_shared<ConvertArguments>();
  parser->footer(
      "  qwsm convert player.log.gz -o carmen.log           any log as CARMEN\n"
      "  qwsm convert robot.log --to odometry -o odom.tum   what odometry says, for eval\n"
      "  qwsm convert sim.log --to truth -o truth.tum       what the simulator knows");
  parser->add_option("LOG", arguments->logs, "logs, one after the other; - is standard input")
      ->required()
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "where to; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  parser->add_option("--to", arguments->format, "carmen, carmen-flaser, odometry or truth")
      ->check(CLI::IsMember({"carmen", "carmen-flaser", "odometry", "truth"}))
      ->type_name("FORM")
      ->capture_default_str();
  AddTopics(*parser, arguments->sources);
  AddRobot(*parser, arguments->sources);
  AddConfiguration(*parser, arguments->sources);
  return {.parser = parser, .run = [arguments] { return RunConvert(*arguments); }};
}

}  // namespace qwsm::apps
