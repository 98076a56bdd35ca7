// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios as YAML: the shipped ones can be run, wrong ones are refused where they are wrong.
#include "service/config/scenario_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include "service/config/options_io.hpp"
#include "service/config/problem.hpp"
#include "service/pipeline/simulation/command_log.hpp"
#include "sim/simulation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm {
namespace {

namespace fs = std::filesystem;

fs::path ScenarioFile(const std::string& name) {
  return fs::path(QWSM_SOURCE_DIR) / "configs" / "scenarios" / (name + ".yaml");
}

sim::ScenarioOptions Shipped(const std::string& name) {
  const fs::path file = ScenarioFile(name);
  auto scenario = config::LoadOptions<sim::ScenarioOptions>({.file = file, .settings = {}});
  pipeline::ReadCommandLogs(file.parent_path(), scenario);
  return scenario;
}

sim::ScenarioOptions LoadText(const std::string& text) {
  sim::ScenarioOptions scenario;
  config::OptionGroup group = config::GroupOf(scenario);
  config::Loader loader(group);
  loader.ReadText(text, "bad.yaml");
  loader.Finish();
  return scenario;
}

std::string Complaint(const std::string& text) {
  try {
    LoadText(text);
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FindScenario, TellsTheNamesThereAre) {
  try {
    config::FindScenario("parc");
    FAIL() << "accepted";
  } catch (const config::ConfigError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("parc: is no file and no scenario (campus, corridor,"), message.npos)
        << message;
    EXPECT_NE(message.find("did you mean 'park'?"), message.npos) << message;
  }
}

class ShippedScenario : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedScenario, CanBeRun) {
  sim::ScenarioOptions scenario = Shipped(GetParam());
  scenario.duration_s = 5.0;
  sim::Simulation simulation(scenario);
  std::size_t readings = 0;
  while (const std::optional<sim::Reading> reading = simulation.Next()) ++readings;
  double expected = 0.0;
  for (const sim::RobotOptions& robot : scenario.robots) {
    expected += robot.laser.rate_hz * std::max(0.0, scenario.duration_s - robot.joins_at_s);
  }
  EXPECT_GE(static_cast<double>(readings), expected);
}

TEST_P(ShippedScenario, IsTheSameAfterDumpAndLoad) {
  const std::string yaml = config::DumpOptions(Shipped(GetParam()));
  EXPECT_EQ(config::DumpOptions(LoadText(yaml)), yaml);
}

INSTANTIATE_TEST_SUITE_P(Scenarios,
                         ShippedScenario,
                         ::testing::Values("park",
                                           "corridor",
                                           "office",
                                           "rubble",
                                           "campus",
                                           "team",
                                           "joystick",
                                           "team_unknown",
                                           "team_wrong",
                                           "team_late",
                                           "team_carried",
                                           "team_wings",
                                           "team_corridor",
                                           "team_campus"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST(ScenarioFile, EveryShippedOneIsTested) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(ScenarioFile("park").parent_path())) {
    files += entry.path().extension() == ".yaml" ? 1 : 0;
  }
  EXPECT_EQ(files, 14U);
}

TEST(ScenarioFile, SaysAllThatIsWrongAndWhere) {
  EXPECT_EQ(Complaint("layout: {knd: park}\n"
                      "robots:\n"
                      "  - mass_kg: -3\n"
                      "    laser:\n"
                      "      beams: 0\n"
                      "      field_of_view_deg: 400\n"),
            "bad.yaml:1:10: layout.knd: unknown option; did you mean 'kind'?\n"
            "bad.yaml:3:14: robots[0].mass_kg: must be between 0.1 and 10000, got -3\n"
            "bad.yaml:5:14: robots[0].laser.beams: must be between 1 and 100000, got 0\n"
            "bad.yaml:6:26: robots[0].laser.field_of_view_deg: must be between 0 and 360, got 400");
}

TEST(ScenarioFile, RefusesARobotInsideAWallAtItsPlace) {
  EXPECT_EQ(Complaint("scenery:\n"
                      "  walls:\n"
                      "    - {from_x_m: -1, from_y_m: 0, to_x_m: 3, to_y_m: 0}\n"
                      "robots:\n"
                      "  - name: outside\n"
                      "    start_x_m: 0\n"
                      "    start_y_m: 2\n"
                      "    driver: {kind: external}\n"
                      "  - name: inside\n"
                      "    start_x_m: 1.5\n"
                      "    driver: {kind: external}\n"),
            "bad.yaml:10:16: robots[1].start_x_m: the robot would start inside a wall, a thing or "
            "another robot");
}

TEST(ScenarioFile, RefusesContradictionsWhereTheyAre) {
  EXPECT_EQ(Complaint("robots:\n"
                      "  - driver: {kind: recorded}\n"
                      "    laser: {useful_range_m: 30, range_max_m: 30}\n"),
            "bad.yaml:2:20: robots[0].driver.commands: a recorded drive needs commands or a "
            "command_log\n"
            "bad.yaml:3:29: robots[0].laser.useful_range_m: must not exceed 97 % of range_max_m, "
            "which stands for 'no echo'");
  EXPECT_EQ(Complaint("seed: 1\n"), "bad.yaml:1:7: robots: a scenario needs one at least");
}

TEST(ScenarioFile, SaysThatAFileIsMissing) {
  try {
    config::LoadOptions<sim::ScenarioOptions>({.file = "no/such.yaml", .settings = {}});
    FAIL() << "nothing was thrown";
  } catch (const config::ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such.yaml: cannot be opened"), std::string::npos)
        << error.what();
  }
}

TEST(ScenarioFile, IsNotTakenForTheFolderOfItsResults) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder.path() / "park");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  const fs::path found = config::FindScenario("park");
  fs::current_path(before);
  EXPECT_EQ(found.filename(), "park.yaml") << found;
}

}  // namespace
}  // namespace qwsm
