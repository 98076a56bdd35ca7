// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// `qwsm compare` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

namespace fs = std::filesystem;

constexpr int kScansCompared = 40;

class CompareCommand : public ::testing::Test {
 protected:
  void SetUp() override { WriteRoomLog(log_, kScansCompared); }

  TemporaryFolder folder_;
  fs::path log_ = folder_.path() / "room.log";
  fs::path results_ = folder_.path() / "results";
};

TEST_F(CompareCommand, LeavesFiguresOfAllMatchersSideBySide) {
  const Outcome outcome = RunProgram({"compare", log_, "--output", results_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("q-wsm against wsm"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("q-wsm against icp"), std::string::npos) << outcome.output;
  const std::string table = ReadFile(results_ / "comparison.csv");
  EXPECT_TRUE(table.starts_with("stamp_s,q-wsm_status,q-wsm_residual_mm,")) << table.substr(0, 200);
  EXPECT_EQ(std::ranges::count(table, '\n'), kScansCompared + 1);
  EXPECT_NE(ReadFile(results_ / "metrics.json").find("\"residual_ratio\""), std::string::npos);
  EXPECT_TRUE(ReadFile(results_ / "residual.png").starts_with("\x89PNG"));
}

TEST_F(CompareCommand, LetsEachMatcherDoWhatItDoesAlone) {
  RunProgram({"compare", log_, "--output", results_});
  for (const std::string matcher : {"q-wsm", "wsm", "icp"}) {
    SCOPED_TRACE(matcher);
    const fs::path alone = folder_.path() / ("alone-" + matcher);
    RunProgram(
        {"map", log_, "--output", alone, "--matcher", matcher, "--set", "graph.enabled=false"});
    EXPECT_EQ(ReadFile(results_ / matcher / "trajectory.tum"), ReadFile(alone / "trajectory.tum"));
    EXPECT_TRUE(fs::exists(results_ / matcher / "map.png"));
  }
}

TEST_F(CompareCommand, ReplacesItsOwnResults) {
  RunProgram({"compare", log_, "--output", results_});
  const Outcome again = RunProgram({"compare", log_, "--output", results_, "--json"});
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(again.output, ReadFile(results_ / "metrics.json"));
}

TEST_F(CompareCommand, DoesNothingWhenDry) {
  const Outcome outcome = RunProgram({"compare", log_, "--output", results_, "--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_TRUE(outcome.output.starts_with("would compare matchers on ")) << outcome.output;
  EXPECT_FALSE(fs::exists(results_));
}

TEST_F(CompareCommand, SaysWhatEndedIt) {
  std::ofstream(log_, std::ios::app) << "FLASER 3 1.0 nonsense\n";
  const Outcome outcome =
      RunProgram({"compare", log_, "--output", results_, "--set", "log.strict=true"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("room.log:41: "), std::string::npos) << outcome.errors;
  EXPECT_TRUE(fs::exists(results_ / "metrics.json"));
}

}  // namespace
}  // namespace qwsm::test
