// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "service/apps/output.hpp"
#include "service/apps/slam6d/commands.hpp"
#include "service/options/slam6d/program_options.hpp"

namespace slam6d::apps {

Command AddConfigCommand(CLI::App& program) {
  CLI::App* parser = AddParser(program, "config", "all options, as YAML or table");
  struct Settings {
    qwsm::config::OptionSources sources;
    bool describe = false;
  };
  auto settings = std::make_shared<Settings>();
  parser->footer(
      "  slam6d config > mine.yaml                  to edit, then: register --config mine.yaml\n"
      "  slam6d config --describe                   a table with units, bounds and help");
  parser->add_flag("--describe", settings->describe, "a table with units, bounds and help");
  qwsm::apps::AddConfiguration(*parser, settings->sources);
  return {.parser = parser, .run = [settings] {
            using options::ProgramOptions;
            const auto options = qwsm::config::LoadOptions<ProgramOptions>(settings->sources);
            qwsm::apps::Print("{}",
                              settings->describe ? qwsm::config::DescribeOptions<ProgramOptions>()
                                                 : qwsm::config::DumpOptions(options));
            return ExitCode::kDone;
          }};
}

}  // namespace slam6d::apps
