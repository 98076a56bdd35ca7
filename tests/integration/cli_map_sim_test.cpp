// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm map --sim` as its users run it: simulator and mapper in one process, with the truth.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "service/io/trajectories/trajectory_file.hpp"
#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class MapSimCommand : public ::testing::Test {
 protected:
  Outcome Map(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"map", "--output", results_});
    return RunProgram(arguments);
  }

  nlohmann::json Metrics() { return nlohmann::json::parse(ReadFile(results_ / "metrics.json")); }

  TemporaryFolder folder_;
  fs::path results_ = folder_.path() / "results";
};

TEST_F(MapSimCommand, MapsAndComparesWithTheTruth) {
  const Outcome outcome =
      Map({"--sim", "rubble", "--duration", "20", "--set", "robots[0].laser.rate_hz=5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("truth          ATE 0.0"), std::string::npos) << outcome.output;
  const nlohmann::json metrics = Metrics();
  EXPECT_EQ(metrics.at("scans"), 101);
  EXPECT_LT(metrics.at("ate_rmse_m"), 0.05);
  EXPECT_LT(metrics.at("loop_gap_m"), 0.1);
  EXPECT_GT(metrics.at("nees"), 0.1);
  EXPECT_NE(ReadFile(results_ / "scenario.yaml").find("rate_hz: 5"), std::string::npos);
  // In the frame of the map, so that nothing has to be aligned.
  const Trajectory truth = io::ReadTumFile(results_ / "truth.tum");
  const Trajectory estimate = io::ReadTumFile(results_ / "trajectory.tum");
  ASSERT_EQ(truth.size(), estimate.size());
  EXPECT_NEAR(truth.back().T_map_robot.x_m, estimate.back().T_map_robot.x_m, 0.1);
}

TEST_F(MapSimCommand, TellsOfABagWhoseStampsDoNotFit) {
  const fs::path simulated = folder_.path() / "simulated";
  const std::string bag = folder_.path() / "drive.mcap";
  RunProgram({"sim", "office", "--duration", "90", "--output", simulated});
  ASSERT_EQ(RunProgram({"convert", simulated / "robot.log", "--output", bag}).exit_code, 0);
  const std::string what = "ahead of odometry, by how both turn; --set log.stamp_offset_s=";
  const Outcome fitting = Map({bag, "--no-pictures"});
  EXPECT_EQ(fitting.errors.find(what), std::string::npos) << fitting.errors;
  const Outcome late = Map({bag, "--no-pictures", "--force", "--set", "log.stamp_offset_s=0.3"});
  EXPECT_NE(late.errors.find(what), std::string::npos) << late.errors;
}

TEST_F(MapSimCommand, GivesTheSameAsTheLogOfThatSimulation) {
  ASSERT_EQ(Map({"--sim", "rubble", "--duration", "5", "--seed", "3"}).exit_code, 0);
  const Trajectory together = io::ReadTumFile(results_ / "trajectory.tum");
  const double nees = Metrics().at("nees");
  const fs::path simulated = folder_.path() / "simulated";
  RunProgram({"sim", "rubble", "--duration", "5", "--seed", "3", "--output", simulated});
  ASSERT_EQ(Map({simulated / "robot.log"}).exit_code, 0);
  const Trajectory apart = io::ReadTumFile(results_ / "trajectory.tum");
  ASSERT_EQ(together.size(), apart.size());
  for (std::size_t i = 0; i < apart.size(); ++i) {
    EXPECT_NEAR(together[i].T_map_robot.x_m, apart[i].T_map_robot.x_m, 1e-3);
    EXPECT_NEAR(together[i].T_map_robot.y_m, apart[i].T_map_robot.y_m, 1e-3);
  }
  EXPECT_NEAR(Metrics().at("nees"), nees, 0.5) << "logs carry the truth";
}

TEST_F(MapSimCommand, TakesSettingsOfTheScenarioAndOfTheMapper) {
  ASSERT_EQ(Map({"--sim",
                 "team",
                 "--robot",
                 "robot_3",
                 "--duration",
                 "2",
                 "--set",
                 "mapper.relevant_translation_m=0.25",
                 "--set",
                 "robots[2].laser.beams=91"})
                .exit_code,
            0);
  EXPECT_NE(ReadFile(results_ / "config.yaml").find("relevant_translation_m: 0.25"),
            std::string::npos);
  EXPECT_NE(ReadFile(results_ / "scenario.yaml").find("beams: 91"), std::string::npos);
}

TEST_F(MapSimCommand, RefusesWhatMakesNoSense) {
  const auto complaint = [this](const std::vector<std::string>& arguments) {
    const Outcome outcome = Map(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(fs::exists(results_));
    return outcome.errors;
  };
  EXPECT_NE(complaint({}).find("either logs or --sim"), std::string::npos);
  EXPECT_NE(complaint({"a.log", "--sim", "park"}).find("either logs or --sim"), std::string::npos);
  EXPECT_NE(complaint({"a.log", "--seed", "1"}).find("belong to --sim"), std::string::npos);
  EXPECT_NE(complaint({"--sim", "team", "--robot", "robt_2"}).find("did you mean 'robot_2'"),
            std::string::npos);
  EXPECT_NE(complaint({"--sim", "park", "--set", "layout.prk=1"}).find("did you mean 'park'"),
            std::string::npos);
}

}  // namespace
}  // namespace qwsm::test
