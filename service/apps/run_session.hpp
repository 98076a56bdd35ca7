// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/apps/command.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/results/results_writer.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/log_source.hpp"
#include "service/pipeline/run/replay.hpp"

namespace qwsm::apps {

/// Arguments of all commands that run a mapper over logs.
struct RunArguments {
  std::vector<std::filesystem::path> logs;
  /// Files and folders that must not be among the results, besides the logs.
  std::vector<std::filesystem::path> other_inputs;
  std::optional<std::filesystem::path> output;
  config::OptionSources sources;
  Verbosity verbosity;
  bool force = false;
  bool dry_run = false;
  bool no_pictures = false;  ///< Whether pictures and the report are left away.
  std::string scenario;      ///< What is run in place of logs.
};

/// Adds the arguments of a run over logs.
/// @param json_help what --json does.
/// @returns the argument LOG, which is required.
CLI::Option* AddRunArguments(
    CLI::App& parser,
    RunArguments& arguments,
    const std::string& json_help = "one JSON object per scan on standard output");

/// Adds the arguments of a run but the logs.
void AddResultArguments(CLI::App& parser, RunArguments& arguments, const std::string& json_help);

/// Whether path and map are corrected; else mapping is incremental, as in Visser et al. (2009).
bool Corrects(const options::ProgramOptions& options);

/// Opens the logs. @throws std::runtime_error where one is no log, or there is no scan in them.
std::unique_ptr<pipeline::LogSource> OpenLogs(const RunArguments& arguments,
                                              const options::LogOptions& options);

/// Tells what would have been done, for --dry-run.
ExitCode TellPlan(const std::string& what, const RunArguments& arguments);

/// One run of a command: its folder is ready, its messages and configuration are recorded there.
/// From then on there is something to keep: Ctrl-C ends the scans, and results are written whole.
class RunSession {
 public:
  /// Makes the folder of the results. @throws io::WriteError where it cannot be had.
  RunSession(const RunArguments& arguments, const options::ProgramOptions& options);

  /// A part of the run, such as one robot's: its results stand in a folder within the run's, and
  /// its messages are those of the run. @throws io::WriteError where the folder cannot be had.
  RunSession Part(const std::string& name) const;

  const pipeline::ResultsFolder& folder() const { return folder_; }
  bool has_pictures() const { return !arguments_.no_pictures; }
  /// What the report of the run says at its top. @param command without the program: "map".
  pipeline::RunTitle Title(const std::string& command, const pipeline::ReplayResult& result) const;

  /// Hands the answers to all scans to the sinks, with progress and messages as asked for.
  pipeline::ReplayResult Run(const std::string& task,
                             pipeline::ScanSource& source,
                             const pipeline::Answer& answer,
                             std::vector<pipeline::StepSink*> sinks) const;

  /// Runs all scans through several mappers, which take turns, with progress and messages as asked
  /// for; their sinks are all there is for answers.
  pipeline::ReplayResult Run(const std::string& task,
                             pipeline::ScanSource& source,
                             std::vector<pipeline::MappingRun> runs) const;

  /// Tells what came out, if a person reads standard output.
  void Summarize(const pipeline::ResultsWriter& results) const;

  bool is_interrupted() const { return interruption_->requested(); }

  /// The exit code of a run whose scans ended so, once its results are written: it says why they
  /// failed, and whether the run was interrupted, after its last scan, too.
  ExitCode Conclude(const pipeline::ReplayResult& result) const;

 private:
  RunSession(RunArguments arguments,
             pipeline::ResultsFolder folder,
             std::shared_ptr<const pipeline::Interruption> interruption)
      : arguments_(std::move(arguments)),
        folder_(std::move(folder)),
        interruption_(std::move(interruption)) {}

  RunArguments arguments_;
  pipeline::ResultsFolder folder_;
  std::shared_ptr<const pipeline::Interruption> interruption_;  ///< One for all parts.
};

}  // namespace qwsm::apps
