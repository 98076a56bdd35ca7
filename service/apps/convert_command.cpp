// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "qwsm/geometry/angle.hpp"
#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/output_check.hpp"
#include "service/io/bags/writing/log_bag_writer.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/io/files/standard_output.hpp"
#include "service/io/logs/carmen_writer.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::vector<fs::path> logs;
  fs::path output = "-";
  std::optional<std::string> format;
  Verbosity verbosity;
  config::OptionSources sources;
};

/// Takes the records of a log and leaves them in another form.
using RecordWriter = std::function<void(const io::LogRecord&)>;

/// Tells once of scans that will not be read as they were.
RecordWriter TellingOfGuesses(const RecordWriter& write) {
  return [write, has_told = false](const io::LogRecord& record) mutable {
    const auto* scan = std::get_if<io::ScanReading>(&record);
    if (scan != nullptr && !has_told && !io::IsGuessedRightly(scan->scan)) {
      has_told = true;
      const LaserGeometry& geometry = scan->scan.geometry;
      messages::Warn(
          "FLASER does not tell that {} beams go from {:.1f} to {:.1f} degrees, and is read as "
          "if they covered what lasers of so many beams do; --to carmen tells it",
          scan->scan.size(),
          RadiansToDegrees(geometry.Bearing(0)),
          RadiansToDegrees(geometry.Bearing(scan->scan.size() - 1)));
    }
    write(record);
  };
}

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
  if (format == "carmen-flaser") {
    return TellingOfGuesses(CarmenRecords(stream, io::CarmenDialect::kFlaser));
  }
  if (format == "odometry") return OdometryAtScans(stream);
  return TruePoses(stream);
}

/// @param as_measured whether the other form keeps the times of beams.
/// @param check is asked after every record, and throws where it could not be written.
void Convert(const ConvertArguments& arguments,
             bool as_measured,
             const RecordWriter& write,
             const std::function<void()>& check) {
  const auto options = config::LoadOptions<options::ProgramOptions>(arguments.sources);
  io::LogOptions log_options = LogOptionsOf(options.log);
  log_options.as_measured = as_measured;
  for (const auto& reader : io::OpenLogs(arguments.logs, log_options)) {
    const std::string& log = reader->report().name;
    bool is_empty = true;
    while (const std::optional<io::LogRecord> record = reader->Next()) {
      is_empty = false;
      write(*record);
      check();
    }
    for (const std::string& note : reader->report().notes) {
      messages::Info("{}: {}", log, note);
    }
    if (is_empty) messages::Warn("{}: holds neither scans nor odometry", log);
  }
}

void ConvertToBag(const ConvertArguments& arguments, io::BagFormat format) {
  if (arguments.output == "-") throw UsageError("a bag is no stream: name it with --output");
  io::BagFile bag(arguments.output, format);
  io::LogBagWriter writer(bag);
  Convert(
      arguments,
      true,
      [&](const io::LogRecord& record) { writer.Write(record); },
      [&] { bag.ThrowIfFailed(); });
  bag.Commit();
}

void ConvertToText(const ConvertArguments& arguments, const std::string& format) {
  if (arguments.output == "-") {
    Convert(arguments, false, MakeWriter(format, std::cout), [] {
      if (!std::cout) throw io::StandardOutputError();
    });
    if (!std::cout.flush()) throw io::StandardOutputError();
    return;
  }
  io::AtomicFile file(arguments.output);
  Convert(arguments, false, MakeWriter(format, file.stream()), [&] { file.ThrowIfFailed(); });
  file.Commit();
}

/// What the name of the output asks for, where nothing else was said: one without an ending is a
/// folder, as `ros2 bag` makes them.
std::string FormatOf(const ConvertArguments& arguments) {
  if (arguments.format) return *arguments.format;
  const std::optional<io::BagFormat> bag = io::BagFormatOf(arguments.output);
  const bool is_folder = arguments.output != "-" && !arguments.output.has_extension();
  if (!bag && !is_folder) return "carmen";
  return bag == io::BagFormat::kSqlite ? "db3" : "mcap";
}

ExitCode RunConvert(const ConvertArguments& arguments) {
  StartMessages(arguments.verbosity);
  const std::string format = FormatOf(arguments);
  RefuseToReplace(arguments.output, arguments.logs);
  if (format == "mcap") {
    ConvertToBag(arguments, io::BagFormat::kMcap);
  } else if (format == "db3") {
    ConvertToBag(arguments, io::BagFormat::kSqlite);
  } else {
    ConvertToText(arguments, format);
  }
  return ExitCode::kDone;
}

}  // namespace

Command AddConvertCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "convert", "logs into other forms");
  auto arguments = std::make_shared<ConvertArguments>();
  parser->footer(
      "  qwsm convert player.log.gz -o carmen.log           any log as CARMEN\n"
      "  qwsm convert drive.bag -o drive.mcap               a bag of ROS 1 for ROS 2\n"
      "  qwsm convert robot.log -o robot                    a folder, as ros2 bag makes them\n"
      "  qwsm convert robot.log --to odometry -o odom.tum   what odometry says, for eval\n"
      "  qwsm convert sim.log --to truth -o truth.tum       what the simulator knows");
  parser
      ->add_option("LOG", arguments->logs, "logs or bags, one after the other; - is standard input")
      ->required()
      ->type_name("");
  parser->add_option("-o,--output", arguments->output, "where to; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  parser
      ->add_option("--to",
                   arguments->format,
                   "carmen, carmen-flaser, mcap, db3, odometry or truth; else by the output's name")
      ->check(CLI::IsMember({"carmen", "carmen-flaser", "mcap", "db3", "odometry", "truth"}))
      ->type_name("FORM");
  AddTopics(*parser, arguments->sources);
  AddRobot(*parser, arguments->sources);
  AddConfiguration(*parser, arguments->sources);
  return {.parser = parser, .run = [arguments] { return RunConvert(*arguments); }};
}

}  // namespace qwsm::apps
