// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm experiment` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

class ExperimentCommand : public ::testing::Test {
 protected:
  Outcome Experiment(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"experiment", "--output", results_});
    return RunProgram(arguments);
  }

  TemporaryFolder folder_;
  fs::path results_ = folder_.path() / "results";
};

TEST_F(ExperimentCommand, JudgesBothMatchersForEverySeed) {
  const Outcome outcome = Experiment({"park", "--seeds", "2", "--seed", "4", "--duration", "60"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("median"), std::string::npos) << outcome.output;
  const auto runs = nlohmann::json::parse(ReadFile(results_ / "metrics.json"));
  ASSERT_EQ(runs.size(), 4U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const nlohmann::json& run = runs[i];
    EXPECT_EQ(run.at("seed"), i < 2 ? 4 : 5);
    EXPECT_EQ(run.at("matcher"), i % 2 == 0 ? "q-wsm" : "wsm");
    EXPECT_EQ(run.at("scans"), 61);
    for (const char* figure : {"residual_mm", "trace_ratio", "loop_gap_m", "ate_rmse_m", "nees"}) {
      EXPECT_GT(run.at(figure), 0.0) << figure;
    }
    for (const char* figure : {"trace_smaller_share", "failures", "ms_median"}) {
      EXPECT_GE(run.at(figure), 0.0) << figure;
    }
  }
  EXPECT_EQ(runs[1].at("trace_ratio"), 1.0) << "of the baseline to itself";
  for (const char* picture : {"figure-3-q-wsm.png", "figure-3-wsm.png", "figure-4.png"}) {
    EXPECT_TRUE(ReadFile(results_ / picture).starts_with("\x89PNG")) << picture;
  }
  EXPECT_TRUE(ReadFile(results_ / "table.csv").starts_with("seed,matcher,scans,"));
  EXPECT_TRUE(ReadFile(results_ / "table.md").starts_with("| matcher | seed |"));
  EXPECT_TRUE(fs::exists(results_ / "seed-5" / "wsm" / "trajectory.tum"));
  EXPECT_NE(ReadFile(results_ / "seed-5" / "scenario.yaml").find("seed: 5"), std::string::npos);
}

TEST_F(ExperimentCommand, RefusesWhatItCannotRun) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"park", "--seeds", "0"},
        std::vector<std::string>{"no-such-place"},
        std::vector<std::string>{"park", "--set", "layout.park.trees=1"},
        std::vector<std::string>{"park", "--set", "mapper.overlap=1"}}) {
    const Outcome outcome = Experiment(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments.back();
    EXPECT_FALSE(outcome.errors.empty());
    EXPECT_FALSE(fs::exists(results_));
  }
}

TEST_F(ExperimentCommand, CanRunTheExamplesOfItsHelp) {
  std::istringstream help(RunProgram({"experiment", "--help"}).output);
  int examples = 0;
  for (std::string line; std::getline(help, line);) {
    const std::string program = "  qwsm ";
    if (!line.starts_with(program)) continue;
    // What an example does stands behind it, two spaces off.
    std::istringstream words(
        line.substr(0, line.find("  ", program.size())).substr(program.size()));
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    arguments.emplace_back("--dry-run");
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << line << outcome.errors;
    ++examples;
  }
  EXPECT_GE(examples, 3);
}

}  // namespace
}  // namespace qwsm::test
