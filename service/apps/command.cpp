// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "service/config/suggestion.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::apps {

CLI::App* AddParser(CLI::App& program, const std::string& name, const std::string& help) {
  return program.add_subcommand(name, help);
}

namespace {

/// The name of the program that has a parser, or a parser within one of its own.
std::string ProgramOf(const CLI::App& parser) {
  const CLI::App* program = &parser;
  while (program->get_parent() != nullptr) program = program->get_parent();
  return program->get_name();
}

}  // namespace

void AddConfiguration(CLI::App& parser, config::OptionSources& sources) {
  const auto take_file = [&sources](const std::string& file) { sources.file = file; };
  parser
      .add_option_function<std::string>(
          "--config", take_file, "options in YAML; see " + ProgramOf(parser) + " config")
      ->type_name("FILE")
      ->group("Configuration");
  const auto take_settings = [&sources](const std::vector<std::string>& settings) {
    sources.settings.insert(sources.settings.end(), settings.begin(), settings.end());
  };
  parser
      .add_option_function<std::vector<std::string>>(
          "--set", take_settings, "one option, over the file's; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->group("Configuration");
}

void AddVerbosity(CLI::App& parser, Verbosity& verbosity, const std::string& json_help) {
  if (!json_help.empty()) {
    parser.add_flag("--json", verbosity.json, json_help)->group("Messages");
  }
  parser.add_flag("-q,--quiet", verbosity.quiet, "no progress and no summary; errors only")
      ->group("Messages");
  parser.add_flag("-v,--verbose", verbosity.verbose, "say more about what is done")
      ->excludes("--quiet")
      ->group("Messages");
}

CLI::Option* AddBagSetting(CLI::App& parser,
                           config::OptionSources& sources,
                           const std::string& flag,
                           const std::string& key,
                           const std::string& help) {
  const auto set = [&sources, key](const std::string& value) {
    sources.settings.push_back(key + "=" + value);
  };
  return parser.add_option_function<std::string>(flag, set, help)->type_name("NAME")->group("Bags");
}

void AddTopics(CLI::App& parser, config::OptionSources& sources) {
  AddBagSetting(
      parser, sources, "--scan", "log.scan", "topics of scans, with commas; else all lasers'");
  AddBagSetting(
      parser, sources, "--odom", "log.odometry", "topic of odometry, or /tf; else chosen");
}

void AddRobot(CLI::App& parser, config::OptionSources& sources) {
  AddBagSetting(
      parser, sources, "--robot", "log.robot", "of several robots, that of this namespace");
}

void AddNoPictures(CLI::App& parser, bool& no_pictures) {
  parser.add_flag("--no-pictures", no_pictures, "data only: no pictures, no report.html");
}

MatcherKind MatcherNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [known, matcher] : Names(MatcherKind{})) {
    if (known == name) return matcher;
    names.emplace_back(known);
  }
  throw UsageError(fmt::format("--matcher: must be one of {}, got '{}'{}",
                               fmt::join(names, ", "),
                               name,
                               config::DidYouMean(name, names)));
}

io::LogOptions LogOptionsOf(const options::LogOptions& options) {
  io::LogOptions log;
  log.strict = options.strict;
  log.mirrored = options.mirrored;
  if (options.range_max_m > 0.0) log.range_max_m = static_cast<float>(options.range_max_m);
  if (options.field_of_view_rad > 0.0) log.field_of_view_rad = options.field_of_view_rad;
  if (options.sweep_s >= 0.0) log.sweep_s = options.sweep_s;
  if (options.laser_height_m > 0.0) log.laser_height_m = options.laser_height_m;
  std::istringstream topics(options.scan);
  for (std::string topic; std::getline(topics, topic, ',');) log.scan_topics.push_back(topic);
  log.stamp_offset_s = options.stamp_offset_s;
  log.odometry_topic = options.odometry;
  log.robot = options.robot;
  log.on_fault = [](const std::string& fault) { messages::Warn(fault); };
  return log;
}

}  // namespace qwsm::apps
