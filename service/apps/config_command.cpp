// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "service/apps/command.hpp"
#include "service/apps/output.hpp"

namespace qwsm::apps {
namespace {

using config::OptionSources;
using options::ProgramOptions;

struct ConfigArguments {
  std::vector<std::filesystem::path> files;
  OptionSources sources;
};

ExitCode Check(const ConfigArguments& arguments) {
  ExitCode worst = ExitCode::kDone;
  for (const std::filesystem::path& file : arguments.files) {
    try {
      config::LoadOptions<ProgramOptions>(OptionSources{.file = file, .settings = {}});
      Print("{}: ok\n", file.string());
    } catch (const config::ConfigError& error) {
      fmt::print(stderr, "{}\n", error.what());
      worst = ExitCode::kUsage;
    }
  }
  return worst;
}

ExitCode Dump(const ConfigArguments& arguments) {
  Print("{}", config::DumpOptions(config::LoadOptions<ProgramOptions>(arguments.sources)));
  return ExitCode::kDone;
}

ExitCode Describe() {
  Print("{}", config::DescribeOptions<ProgramOptions>());
  return ExitCode::kDone;
}

}  // namespace

std::vector<Command> AddConfigCommands(CLI::App& program) {
  CLI::App* group = AddParser(program, "config", "what can be configured, and whether files do");
  group->footer(
      "  qwsm config describe                       all options, their units and bounds\n"
      "  qwsm config dump > robot.yaml              a file to start from\n"
      "  qwsm config check robot.yaml               all that is wrong with it at once");
  group->require_subcommand(1);
  auto arguments = std::make_shared<ConfigArguments>();

  CLI::App* check = AddParser(*group, "check", "whether files can be used");
  check->add_option("FILE", arguments->files, "options in YAML")->required()->type_name("");
  CLI::App* dump = AddParser(*group, "dump", "all options with their values, as YAML");
  AddConfiguration(*dump, arguments->sources);
  CLI::App* describe = AddParser(*group, "describe", "all options as a table");
  return {{.parser = check, .run = [arguments] { return Check(*arguments); }},
          {.parser = dump, .run = [arguments] { return Dump(*arguments); }},
          {.parser = describe, .run = Describe}};
}

}  // namespace qwsm::apps
