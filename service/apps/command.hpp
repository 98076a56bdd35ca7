// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "service/config/options_io.hpp"
#include "service/options/program_options.hpp"

namespace qwsm::apps {

/// Exit codes of the program; all commands have the same.
enum class ExitCode {
  kDone = 0,
  kFailed = 1,  ///< The command ran, but the result is not what was asked for.
  kUsage = 2,   ///< The arguments, the configuration or the input are wrong.
  kIo = 3,      ///< The results could not be written.
  kInterrupted = 130,
};

/// Tells of arguments that are each right but make no sense together.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command: what its arguments are, and what it does once they are parsed.
struct Command {
  CLI::App* parser = nullptr;
  std::function<ExitCode()> run;
};

/// Says how much is told on stderr, and in what form.
struct Verbosity {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
};

/// Adds a command to a program or to a group of commands. Creating parsers in one source only
/// spares the others much of CLI11.
CLI::App* AddParser(CLI::App& program, const std::string& name, const std::string& help);

/// Adds the arguments --config and --set.
void AddConfiguration(CLI::App& parser, config::OptionSources& sources);

/// Adds an argument that says what of a bag is read, and stands for a setting of the configuration.
CLI::Option* AddBagSetting(CLI::App& parser,
                           config::OptionSources& sources,
                           const std::string& flag,
                           const std::string& key,
                           const std::string& help);

/// Adds the arguments --scan and --odom, which say what of a bag is read, as settings.
void AddTopics(CLI::App& parser, config::OptionSources& sources);

/// Adds the argument --robot, which says whose scans of a bag are read, as a setting.
void AddRobot(CLI::App& parser, config::OptionSources& sources);

/// Adds the arguments --quiet, --verbose and, where it has a meaning, --json.
void AddVerbosity(CLI::App& parser, Verbosity& verbosity, const std::string& json_help);

/// Adds the argument --no-pictures, for runs that leave pictures and a report.
void AddNoPictures(CLI::App& parser, bool& no_pictures);

/// The matcher of a name given after --matcher. @throws UsageError.
MatcherKind MatcherNamed(const std::string& name);

/// Options for reading logs; their faults become messages.
io::LogOptions LogOptionsOf(const options::LogOptions& options);

// These add one command each, and stand in a file each.
Command AddMapCommand(CLI::App& program);
Command AddLocalizeCommand(CLI::App& program);
Command AddCompareCommand(CLI::App& program);
Command AddEvalCommand(CLI::App& program);
Command AddConvertCommand(CLI::App& program);
Command AddExportCommand(CLI::App& program);
Command AddSimCommand(CLI::App& program);
Command AddExperimentCommand(CLI::App& program);
Command AddServeCommand(CLI::App& program);
Command AddReplayCommand(CLI::App& program);
Command AddEchoCommand(CLI::App& program);
Command AddWatchCommand(CLI::App& program);
Command AddRecordCommand(CLI::App& program);
std::vector<Command> AddConfigCommands(CLI::App& program);

}  // namespace qwsm::apps
