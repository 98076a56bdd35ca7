// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cstddef>
#include <exception>
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

/// Leaves a record of a log in another form. @return whether that form holds such records.
using RecordWriter = std::function<bool(const io::LogRecord&)>;

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
    return write(record);
  };
}

RecordWriter CarmenRecords(std::ostream& stream, io::CarmenDialect dialect) {
  auto writer = std::make_shared<io::CarmenWriter>(stream, dialect);
  return [writer](const io::LogRecord& record) {
    writer->Write(record);
    return true;
  };
}

RecordWriter OdometryAtScans(std::ostream& stream) {
  return [&stream](const io::LogRecord& record) {
    const auto* scan = std::get_if<io::ScanReading>(&record);
    if (scan == nullptr || !scan->T_odom_robot) return false;
    io::WriteTumLine(stream, {.stamp = scan->scan.stamp, .T_map_robot = *scan->T_odom_robot});
    return true;
  };
}

RecordWriter TruePoses(std::ostream& stream) {
  return [&stream](const io::LogRecord& record) {
    const auto* truth = std::get_if<io::TruePoseReading>(&record);
    if (truth == nullptr) return false;
    io::WriteTumLine(stream, {.stamp = truth->stamp, .T_map_robot = truth->T_world_robot});
    return true;
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

/// Where records go, and what they become there.
struct Target {
  RecordWriter write;
  std::function<void()> check;   ///< Is asked after every record, and throws where it failed.
  std::function<void()> commit;  ///< Is told that all is there.
};

/// Writes the records of a log.
/// @param written counts those that the form holds, also where the log is damaged behind them.
void ConvertLog(io::LogReader& log, const Target& target, std::size_t& written) {
  while (const std::optional<io::LogRecord> record = log.Next()) {
    if (target.write(*record)) ++written;
    target.check();
  }
  for (const std::string& note : log.report().notes) {
    messages::Info("{}: {}", log.report().name, note);
  }
}

std::string NothingOf(const std::string& format) {
  if (format == "odometry") return "holds no scan with odometry";
  if (format == "truth") return "tells no true pose, as logs of the simulator do";
  return "holds neither scans nor odometry";
}

/// Of a log that is damaged, what stands before the damage is kept.
/// @param as_measured whether the other form keeps the times of beams.
void Convert(const ConvertArguments& arguments,
             const std::string& format,
             bool as_measured,
             const Target& target) {
  const auto options = config::LoadOptions<options::ProgramOptions>(arguments.sources);
  io::LogOptions log_options = LogOptionsOf(options.log);
  log_options.as_measured = as_measured;
  std::size_t written = 0;
  std::exception_ptr damage;
  std::vector<std::string> without;
  for (const auto& log : io::OpenLogs(arguments.logs, log_options)) {
    const std::size_t before = written;
    try {
      ConvertLog(*log, target, written);
    } catch (const io::LogError&) {
      damage = std::current_exception();
      break;
    }
    if (written == before) without.push_back(log->report().name + ": " + NothingOf(format));
  }
  if (written > 0) target.commit();
  if (damage) std::rethrow_exception(damage);
  if (written == 0) throw UsageError(without.front() + "; nothing is written");
  for (const std::string& log : without) messages::Warn(log);
}

void ConvertToBag(const ConvertArguments& arguments, const std::string& format) {
  if (arguments.output == "-") throw UsageError("a bag is no stream: name it with --output");
  io::BagFile bag(arguments.output,
                  format == "db3" ? io::BagFormat::kSqlite : io::BagFormat::kMcap);
  io::LogBagWriter writer(bag);
  Convert(arguments,
          format,
          true,
          {.write =
               [&](const io::LogRecord& record) {
                 writer.Write(record);
                 return true;
               },
           .check = [&] { bag.ThrowIfFailed(); },
           .commit = [&] { bag.Commit(); }});
}

void ConvertToText(const ConvertArguments& arguments, const std::string& format) {
  if (arguments.output == "-") {
    const auto check = [] {
      if (!std::cout) throw io::StandardOutputError();
    };
    const auto commit = [] {
      if (!std::cout.flush()) throw io::StandardOutputError();
    };
    return Convert(arguments,
                   format,
                   false,
                   {.write = MakeWriter(format, std::cout), .check = check, .commit = commit});
  }
  io::AtomicFile file(arguments.output);
  Convert(arguments,
          format,
          false,
          {.write = MakeWriter(format, file.stream()),
           .check = [&] { file.ThrowIfFailed(); },
           .commit = [&] { file.Commit(); }});
}

/// What the name of the output asks for, where nothing else was said: one without an ending is a
/// folder, as `ros2 bag` makes them.
std::string FormatOf(const ConvertArguments& arguments) {
  if (arguments.format) return *arguments.format;
  if (arguments.output.extension() == ".bag") {
    throw UsageError(arguments.output.string() +
                     ": bags of ROS 1 are read, but not written; name it .mcap or .db3, for ROS 2");
  }
  const std::optional<io::BagFormat> bag = io::BagFormatOf(arguments.output);
  const bool is_folder = arguments.output != "-" && !arguments.output.has_extension();
  if (!bag && !is_folder) return "carmen";
  return bag == io::BagFormat::kSqlite ? "db3" : "mcap";
}

ExitCode RunConvert(const ConvertArguments& arguments) {
  StartMessages(arguments.verbosity);
  const std::string format = FormatOf(arguments);
  RefuseToReplace(arguments.output, arguments.logs);
  if (format == "mcap" || format == "db3") {
    ConvertToBag(arguments, format);
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
