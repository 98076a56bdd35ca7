// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/run_session.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "service/apps/messages.hpp"
#include "service/apps/output.hpp"
#include "service/apps/version.hpp"
#include "service/io/files/atomic_file.hpp"
#include "service/pipeline/results/json_lines_sink.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {

using namespace pipeline;

namespace {

std::vector<std::filesystem::path> InputsOf(const RunArguments& arguments) {
  std::vector<std::filesystem::path> inputs = arguments.logs;
  inputs.insert(inputs.end(), arguments.other_inputs.begin(), arguments.other_inputs.end());
  return inputs;
}

}  // namespace

CLI::Option* AddRunArguments(CLI::App& parser,
                             RunArguments& arguments,
                             const std::string& json_help) {
  CLI::Option* logs =
      parser
          .add_option(
              "LOG", arguments.logs, "logs or bags, parts of one recording; - is standard input")
          ->required()
          ->type_name("");
  AddTopics(parser, arguments.sources);
  AddResultArguments(parser, arguments, json_help);
  return logs;
}

void AddResultArguments(CLI::App& parser, RunArguments& arguments, const std::string& json_help) {
  parser.add_option("-o,--output", arguments.output, "folder for the results; else results/<time>")
      ->type_name("DIR");
  parser.add_flag("--force", arguments.force, "write into a folder that holds other things");
  parser.add_flag("-n,--dry-run", arguments.dry_run, "check everything, do nothing");
  AddConfiguration(parser, arguments.sources);
  AddVerbosity(parser, arguments.verbosity, json_help);
}

bool Corrects(const options::ProgramOptions& options) {
  return options.graph.enabled && options.mapper.matcher == MatcherKind::kQWsm;
}

std::unique_ptr<LogSource> OpenLogs(const RunArguments& arguments,
                                    const options::LogOptions& options) {
  auto source = std::make_unique<LogSource>(arguments.logs, LogOptionsOf(options));
  if (source->Peek() == nullptr) {
    throw UsageError(fmt::format("there is no scan in {}; {}",
                                 arguments.logs.front().string(),
                                 fmt::join(source->Describe(), "; ")));
  }
  return source;
}

ExitCode TellPlan(const std::string& what, const RunArguments& arguments) {
  if (arguments.output) {
    ResultsFolder::Check(*arguments.output, arguments.force, InputsOf(arguments));
  }
  for (const std::filesystem::path& log : arguments.logs) {
    Print("would {} {}\n", what, log.string());
  }
  Print("into {}\n", arguments.output.value_or("results/<time>").string());
  return ExitCode::kDone;
}

RunSession::RunSession(const RunArguments& arguments, const options::ProgramOptions& options)
    : arguments_(arguments),
      folder_(arguments.output
                  ? ResultsFolder(*arguments.output, arguments.force, InputsOf(arguments))
                  : ResultsFolder::ForNow("results")),
      interruption_(std::make_shared<const Interruption>()) {
  CopyMessagesTo(folder_ / ResultFile::kLog);
  messages::Info("version {}", Version());
  io::WriteTextFile(folder_ / ResultFile::kConfig, config::DumpOptions(options));
}

RunSession RunSession::Part(const std::string& name) const {
  return {arguments_, folder_.Part(name, arguments_.force, InputsOf(arguments_)), interruption_};
}

RunTitle RunSession::Title(const std::string& command, const ReplayResult& result) const {
  RunTitle title{.command = "qwsm " + command,
                 .version = std::string(Version()),
                 .inputs = {},
                 .interrupted = result.end != ReplayEnd::kExhausted};
  if (!arguments_.scenario.empty()) {
    title.command += " --sim";
    title.inputs.push_back(arguments_.scenario);
  }
  for (const std::filesystem::path& input : InputsOf(arguments_)) {
    title.inputs.push_back(input.string());
  }
  return title;
}

ReplayResult RunSession::Run(const std::string& task,
                             ScanSource& source,
                             const Answer& answer,
                             std::vector<StepSink*> sinks) const {
  JsonLinesSink json(stdout);
  if (arguments_.verbosity.json) sinks.push_back(&json);
  return Run(task, source, {{.answer = answer, .sinks = std::move(sinks)}});
}

ReplayResult RunSession::Run(const std::string& task,
                             ScanSource& source,
                             std::vector<MappingRun> runs) const {
  ProgressDisplay progress(
      task, source, arguments_.verbosity.quiet ? ProgressStyle::kNone : StyleFor(stderr));
  runs.back().sinks.push_back(&progress);  // Once per scan.
  ReplayResult result = Replay(source, runs, [&] { return is_interrupted(); });
  progress.Clear();
  for (const std::string& line : source.Describe()) messages::Info(line);
  return result;
}

void RunSession::Summarize(const ResultsWriter& results) const {
  if (arguments_.verbosity.quiet || arguments_.verbosity.json) return;
  Print("{}results        {}\n",
        SummaryText(results.statistics(), results.map(), results.truth_report(), results.loops()),
        folder_.path().string());
}

ExitCode RunSession::Conclude(const ReplayResult& result) const {
  switch (result.end) {
    case ReplayEnd::kExhausted:
      return is_interrupted() ? ExitCode::kInterrupted : ExitCode::kDone;
    case ReplayEnd::kInterrupted:
      return ExitCode::kInterrupted;
    case ReplayEnd::kSourceFailed:
      break;
  }
  messages::Error(result.failure);
  return ExitCode::kUsage;
}

}  // namespace qwsm::apps
