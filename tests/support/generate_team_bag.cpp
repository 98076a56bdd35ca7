// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Writes what a simulated team measures as a bag of several robots, for `qwsm map`:
//
//   generate_team_bag SCENARIO SEED DURATION_S BAG
//
// SCENARIO is a name, or a file.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "service/config/options_io.hpp"
#include "service/config/scenario_file.hpp"
#include "tests/support/team_bag.hpp"

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: generate_team_bag SCENARIO SEED DURATION_S BAG\n");
    return 2;
  }
  try {
    const std::vector<std::string> settings{std::string("seed=") + argv[2],
                                            std::string("duration_s=") + argv[3]};
    const auto scenario = qwsm::config::LoadOptions<sim::ScenarioOptions>(
        {.file = qwsm::config::FindScenario(argv[1]), .settings = settings});
    std::vector<std::string> names;
    for (const sim::RobotOptions& robot : scenario.robots) names.push_back(robot.name);
    qwsm::test::WriteTeamBag(qwsm::test::ReadingsOf(scenario, names.size()), names, argv[4]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_team_bag: %s\n", error.what());
    return 1;
  }
  return 0;
}
