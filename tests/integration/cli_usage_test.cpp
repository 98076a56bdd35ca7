// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What the program says to mistakes, and with which exit code.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {
namespace {

TEST(Usage, HelpShowsExamplesFirst) {
  const Outcome outcome = RunProgram({"map", "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  const std::size_t examples = outcome.output.find("Examples:");
  EXPECT_LT(examples, outcome.output.find("Options:"));
  EXPECT_LT(examples, outcome.output.find("Usage:"));
  EXPECT_EQ(outcome.errors, "");
}

TEST(Usage, VersionNamesTheProgram) {
  const Outcome outcome = RunProgram({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.output.starts_with("qwsm 0.")) << outcome.output;
}

TEST(Usage, SuggestsCommandsAndOptions) {
  const Outcome command = RunProgram({"mpa", "room.log"});
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_EQ(command.errors,
            "qwsm: unknown command 'mpa'; did you mean 'map'?\nqwsm: see 'qwsm --help'\n");
  const Outcome option = RunProgram({"map", "room.log", "--matchr", "wsm"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_EQ(option.errors,
            "qwsm: unknown option '--matchr'; did you mean '--matcher'?\n"
            "qwsm: see 'qwsm map --help'\n");
}

TEST(Usage, NamesTheMatchers) {
  const Outcome outcome = RunProgram({"map", "room.log", "--matcher", "q-wms"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            "qwsm: --matcher: must be one of q-wsm, wsm, icp, got 'q-wms'; "
            "did you mean 'q-wsm'?\n");
}

TEST(Usage, CountsFromOne) {
  for (const char* count : {"0", "-1"}) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"echo"}, std::vector<std::string>{"record", "none.mcap"}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {"--count", count});
      const Outcome outcome = RunProgram(arguments);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_NE(outcome.errors.find("--count: must be a number between 1 and"), std::string::npos)
          << outcome.errors;
    }
  }
}

TEST(Usage, AsksForWhatIsMissing) {
  EXPECT_EQ(RunProgram({}).exit_code, 2);
  const Outcome outcome = RunProgram({"map"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("needs either logs or --sim"), std::string::npos) << outcome.errors;
}

TEST(Usage, NamesAMissingLog) {
  const TemporaryFolder folder;
  const Outcome outcome = RunProgram({"map", "no-such.log", "--output", folder.path() / "results"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("no-such.log"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("No such file"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "results"));
}

TEST(Usage, RefusesWhatIsNoLog) {
  const TemporaryFolder folder;
  const std::filesystem::path garbage = folder.path() / "garbage";
  std::ofstream(garbage, std::ios::binary) << std::string(5000, '\x80') << "\nGARBAGE 1 2 3\n";
  const Outcome outcome = RunProgram({"map", garbage, "--output", folder.path() / "results"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.errors.find("garbage"), std::string::npos) << outcome.errors;
}

TEST(Usage, RefusesLogsWithoutScans) {
  const TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "odometry.log";
  std::ofstream(log) << "ODOM 0 0 0 0 0 0 1 robot 1\nODOM 1 0 0 0 0 0 2 robot 2\n";
  const Outcome outcome = RunProgram({"map", log, "--output", folder.path() / "results"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(outcome.errors.starts_with("qwsm: there is no scan in " + log.string() + "; "))
      << outcome.errors;
}

TEST(Usage, NamesWhatOptionsOfBeforeAreCalledNow) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "robot.yaml";
  std::ofstream(file) << "mapper:\n  surroundings:\n    points: 100\n";
  const Outcome outcome = RunProgram({"config",
                                      "dump",
                                      "--config",
                                      file,
                                      "--set",
                                      "mapper.surroundings.points=100",
                                      "--set",
                                      "mapper.locator.known_places.search.prior_points=0.2"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            file.string() + ":2:3: mapper.surroundings: is now called 'mapper.submap'\n" +
                "--set mapper.surroundings.points: is now called 'mapper.submap.points'\n" +
                "--set mapper.locator.known_places.search.prior_points: is now called "
                "'mapper.locator.loop_closure.search.prior_cost_points'\n");
}

TEST(Usage, ReportsAllConfigurationProblemsBeforeAnythingIsDone) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "robot.yaml";
  std::ofstream(file) << "mapper:\n  matchr: wsm\n  extended_below_overlap: 7\n";
  const std::filesystem::path results = folder.path() / "results";
  const Outcome outcome = RunProgram(
      {"map", "room.log", "-o", results, "--config", file, "--set", "mapper.matcher=wms"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.errors,
            file.string() + ":2:3: mapper.matchr: unknown option; did you mean 'matcher'?\n" +
                file.string() +
                ":3:27: mapper.extended_below_overlap: must be between 0 and 1, got 7\n" +
                "--set mapper.matcher: must be one of q-wsm, wsm, icp, got 'wms'; "
                "did you mean 'wsm'?\n");
  EXPECT_FALSE(std::filesystem::exists(results));
}

TEST(Usage, RefusesNumbersThatAreNone) {
  const std::vector<std::vector<std::string>> commands{
      {"sim", "park", "--speed", "nan"},
      {"sim", "park", "--speed", "inf"},
      {"sim", "park", "--duration", "nan"},
      {"replay", "room.log", "--rate", "1e-300"},
      {"replay", "room.log", "--wait", "nan"},
      {"eval", "a.tum", "--truth", "b.tum", "--max-time-diff", "nan"},
      {"eval", "a.tum", "--truth", "b.tum", "--max-ate", "nan"},
      {"echo", "--duration", "inf"},
      {"watch", "--duration", "1e300"},
      {"watch", "--period", "nan"}};
  for (const std::vector<std::string>& command : commands) {
    SCOPED_TRACE(command.front() + " " + command[command.size() - 2]);
    const Outcome outcome = RunProgram(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.errors.find(command.back()), std::string::npos) << outcome.errors;
  }
}

TEST(Usage, RefusesOutputsWithoutAName) {
  const TemporaryFolder folder;
  const std::string log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  for (const auto& [command, option] : {std::pair{"map", "--output"},
                                        std::pair{"map", "--save-map"},
                                        std::pair{"convert", "--output"}}) {
    const Outcome outcome = RunProgram({command, log, option, ""});
    EXPECT_EQ(outcome.exit_code, 3) << command;
    EXPECT_TRUE(outcome.errors.starts_with(std::string("qwsm: ") + option + ": is empty"))
        << outcome.errors;
  }
}

TEST(Usage, SaysWhyResultsCannotBeWritten) {
  const TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "room.log";
  WriteRoomLog(log, 3);
  const Outcome nowhere = RunProgram({"map", log, "--output", "/proc/results"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_NE(nowhere.errors.find("/proc/results"), std::string::npos) << nowhere.errors;
  const Outcome file = RunProgram({"map", log, "--output", log});
  EXPECT_EQ(file.exit_code, 3);
  EXPECT_NE(file.errors.find("is a file"), std::string::npos) << file.errors;
}

}  // namespace
}  // namespace qwsm::test
