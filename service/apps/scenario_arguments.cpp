// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/apps/scenario_arguments.hpp"

#include <algorithm>

#include "service/config/options_io.hpp"
#include "service/config/scenario_file.hpp"
#include "service/pipeline/simulation/command_log.hpp"

namespace qwsm::apps {

void AddScenarioSettings(CLI::App& parser, ScenarioArguments& arguments) {
  // As text, so that they are checked like what a file says.
  parser.add_option("--seed", arguments.seed, "another seed than the scenario's")
      ->type_name("N")
      ->group("Simulation");
  parser.add_option("--duration", arguments.duration_s, "simulated seconds at most")
      ->type_name("S")
      ->group("Simulation");
}

sim::ScenarioOptions LoadScenario(const ScenarioArguments& arguments) {
  config::OptionSources sources{.file = config::FindScenario(arguments.scenario),
                                .settings = arguments.settings};
  if (arguments.seed) sources.settings.push_back("seed=" + *arguments.seed);
  if (arguments.duration_s) sources.settings.push_back("duration_s=" + *arguments.duration_s);
  auto scenario = config::LoadOptions<sim::ScenarioOptions>(sources);
  pipeline::ReadCommandLogs(sources.file->parent_path(), scenario);
  return scenario;
}

std::string ScenarioText(const sim::ScenarioOptions& scenario) {
  return config::DumpOptions(scenario);
}

std::vector<std::string> TakeScenarioSettings(std::vector<std::string>& settings) {
  sim::ScenarioOptions scenario;
  config::OptionGroup options = config::GroupOf(scenario);
  const auto others = std::ranges::stable_partition(settings, [&](const std::string& setting) {
    return options.Find(setting.substr(0, setting.find_first_of(".[="))) == nullptr;
  });
  std::vector<std::string> taken(others.begin(), others.end());
  settings.erase(others.begin(), others.end());
  return taken;
}

}  // namespace qwsm::apps
