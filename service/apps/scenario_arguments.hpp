// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario.hpp"

namespace qwsm::apps {

/// Says which scenario is run, and with which changes.
struct ScenarioArguments {
  std::string scenario;               ///< A file of a scenario, or the name of a shipped one.
  std::vector<std::string> settings;  ///< `key=value`, as given after --set.
  std::optional<std::string> seed;
  std::optional<std::string> duration_s;
};

/// Adds the arguments --seed and --duration.
void AddScenarioSettings(CLI::App& parser, ScenarioArguments& arguments);

/// The scenario with all changes. @throws config::ConfigError naming every problem at once.
sim::ScenarioOptions LoadScenario(const ScenarioArguments& arguments);

/// The text of a file from which the scenario can be read again.
std::string ScenarioText(const sim::ScenarioOptions& scenario);

/// Takes those `key=value` out of `settings` whose key is an option of scenarios, and returns them.
std::vector<std::string> TakeScenarioSettings(std::vector<std::string>& settings);

}  // namespace qwsm::apps
