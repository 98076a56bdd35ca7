// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/messages.hpp"
#include "service/apps/version.hpp"
#include "service/io/atomic_file.hpp"
#include "service/pipeline/interruption.hpp"
#include "service/pipeline/json_lines_sink.hpp"
#include "service/pipeline/log_source.hpp"
#include "service/pipeline/progress_display.hpp"
#include "service/pipeline/replay.hpp"
#include "service/pipeline/results_folder.hpp"
#include "service/pipeline/run_report.hpp"
#include "service/pipeline/scan_table_sink.hpp"
#include "service/pipeline/trajectory_sink.hpp"

namespace qwsm::apps {
namespace {

namespace fs = std::filesystem;
using namespace pipeline;

struct MapArguments {
  std::vector<fs::path> logs;
  std::optional<fs::path> output;
  std::optional<std::string> matcher;
  config::OptionSources sources;
  Verbosity verbosity;
  bool force = false;
  bool dry_run = false;
};

config::ProgramOptions LoadOptions(const MapArguments& arguments) {
  auto options = config::LoadOptions<config::ProgramOptions>(arguments.sources);
  if (arguments.matcher) options.mapper.matcher = MatcherNamed(*arguments.matcher);
  return options;
}

ResultsFolder MakeFolder(const MapArguments& arguments) {
  return arguments.output ? ResultsFolder(*arguments.output, arguments.force)
                          : ResultsFolder::ForNow("results");
}

ExitCode Conclude(const ReplayResult& result) {
  switch (result.end) {
    case ReplayEnd::kExhausted:
      return ExitCode::kDone;
    case ReplayEnd::kInterrupted:
      return ExitCode::kInterrupted;
    case ReplayEnd::kSourceFailed:
      break;
  }
  spdlog::error("{}", result.failure);
  return ExitCode::kUsage;
}

ExitCode RunMap(const MapArguments& arguments) {
  StartMessages(arguments.verbosity);
  const config::ProgramOptions options = LoadOptions(arguments);
  LogSource source(arguments.logs, LogOptionsOf(options.log));
  const ResultsFolder folder = MakeFolder(arguments);
  CopyMessagesTo(folder / "run.log");
  spdlog::info("version {}", Version());
  io::WriteTextFile(folder / "config.yaml", config::DumpOptions(options));

  Mapper mapper(options.mapper);
  TrajectorySink trajectory(folder / "trajectory.tum");
  ScanTableSink table(folder / "scans.csv");
  RunStatistics statistics;
  ProgressDisplay progress(
      "map", source, arguments.verbosity.quiet ? ProgressStyle::kNone : StyleFor(stderr));
  JsonLinesSink json(stdout);
  std::vector<StepSink*> sinks{&trajectory, &table, &statistics, &progress};
  if (arguments.verbosity.json) sinks.push_back(&json);
  const Interruption interruption;
  const ReplayResult result =
      Replay(source, mapper, sinks, [&] { return interruption.requested(); });
  progress.Clear();

  trajectory.Commit();
  table.Commit();
  io::WriteTextFile(folder / "metrics.json",
                    MetricsJson(statistics, mapper.map(), options.mapper.matcher));
  for (const std::string& line : source.Describe()) spdlog::info("{}", line);
  if (statistics.scans() == 0 && result.end == ReplayEnd::kExhausted) {
    throw UsageError("there is no scan in " + arguments.logs.front().string());
  }
  if (!arguments.verbosity.quiet && !arguments.verbosity.json) {
    fmt::print(
        "{}results        {}\n", SummaryText(statistics, mapper.map()), folder.path().string());
  }
  return Conclude(result);
}

}  // namespace

Command AddMapCommand(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("map", "the robot's path and a map from recorded logs");
  auto arguments = std::make_shared<MapArguments>();
  parser->footer(
      "  qwsm map intel.log.gz                            results in results/latest\n"
      "  qwsm map intel.log --output intel                results in intel/\n"
      "  qwsm map intel.log --matcher wsm                 the incremental baseline\n"
      "  qwsm map robot.log --set mapper.motion.rotation_per_rotation=0.5\n"
      "  zcat *.log.gz | qwsm map - --quiet               from a pipe");
  parser->add_option("LOG", arguments->logs, "logs, parts of one recording; - is standard input")
      ->required()
      ->type_name("");
  parser
      ->add_option("-o,--output", arguments->output, "folder for the results; else results/<time>")
      ->type_name("DIR");
  parser->add_flag("--force", arguments->force, "write into a folder that holds other things");
  parser->add_option("--matcher", arguments->matcher, "q-wsm, wsm or icp")->type_name("NAME");
  AddConfiguration(*parser, arguments->sources);
  AddVerbosity(*parser, arguments->verbosity, "one JSON object per scan on standard output");
  return {.parser = parser, .run = [arguments] { return RunMap(*arguments); }};
}

}  // namespace qwsm::apps
