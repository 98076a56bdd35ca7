// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "service/config/describe.hpp"
#include "service/config/loader.hpp"
#include "tests/support/robot_options.hpp"

namespace qwsm::config {
namespace {

using test::Drive;
using test::RobotOptions;

RobotOptions LoadRobot(const std::string& text, const std::vector<std::string>& settings = {}) {
  RobotOptions options;
  OptionGroup group = GroupOf(options);
  Loader loader(group);
  loader.ReadText(text, "robot.yaml");
  for (const std::string& setting : settings) loader.Set(setting);
  loader.Finish();
  return options;
}

std::string ComplaintOfRobot(const std::string& text, const std::vector<std::string>& settings = {}) {
  try {
    LoadRobot(text, settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Loader, ReadsEveryKindOfOption) {
  const RobotOptions options = LoadRobot(R"(
max_iterations: 7
verbose: true
drive: differential
laser:
  range_max_m: 8.5
  field_of_view_deg: 90
)");
  EXPECT_EQ(options.max_iterations, 7);
  EXPECT_TRUE(options.verbose);
  EXPECT_EQ(options.drive, Drive::kDifferential);
  EXPECT_EQ(options.laser.range_max_m, 8.5);
  EXPECT_DOUBLE_EQ(options.laser.field_of_view_rad, std::numbers::pi / 2.0);
  EXPECT_EQ(options.laser.range_min_m, 0.1) << "not given, so the default";
}

TEST(Loader, TakesNothingForNoChange) {
  for (const char* text : {"", "# only a comment\n", "laser:\n", "---\n", "{}"}) {
    EXPECT_EQ(ComplaintOfRobot(text), "accepted") << text;
  }
}

TEST(Loader, ReportsAllProblemsAtOnceSortedByLine) {
  EXPECT_EQ(ComplaintOfRobot("max_iteration: 3\n"
                      "drive: skd\n"
                      "laser:\n"
                      "  range_max_m: soon\n"
                      "  field_of_view_deg: 361\n"
                      "verbose: yes\n"),
            "robot.yaml:1:1: max_iteration: unknown option; did you mean 'max_iterations'?\n"
            "robot.yaml:2:8: drive: must be one of skid, differential, got 'skd'; "
            "did you mean 'skid'?\n"
            "robot.yaml:4:16: laser.range_max_m: expected a number, got 'soon'\n"
            "robot.yaml:5:22: laser.field_of_view_deg: must be between 0 and 360, got 361\n"
            "robot.yaml:6:10: verbose: expected true or false, got 'yes'");
}

TEST(Loader, AcceptsAnAngleAtItsBound) {
  EXPECT_EQ(ComplaintOfRobot("laser: {field_of_view_deg: 360}"), "accepted");
}

TEST(Loader, RefusesWhatIsNoNumber) {
  for (const char* text : {".nan", ".inf", "-.Inf", "nan", "inf"}) {
    EXPECT_EQ(
        ComplaintOfRobot("laser: {range_max_m: " + std::string(text) + "}"),
        "robot.yaml:1:22: laser.range_max_m: must be finite, got '" + std::string(text) + "'");
  }
  EXPECT_EQ(ComplaintOfRobot("max_iterations: 3.5"),
            "robot.yaml:1:17: max_iterations: expected a whole number, got '3.5'");
  EXPECT_EQ(ComplaintOfRobot("max_iterations: '3'"),
            "robot.yaml:1:17: max_iterations: expected a whole number, got '3'");
  EXPECT_EQ(ComplaintOfRobot("max_iterations: [3]"),
            "robot.yaml:1:17: max_iterations: expected a whole number, got a list");
  EXPECT_EQ(ComplaintOfRobot("max_iterations:"),
            "robot.yaml:1:1: max_iterations: expected a whole number, got nothing");
  EXPECT_EQ(ComplaintOfRobot("max_iterations: 99999999999"),
            "robot.yaml:1:17: max_iterations: expected a whole number, got '99999999999'");
}

TEST(Loader, NamesTheGroupOfAMisplacedOption) {
  EXPECT_EQ(ComplaintOfRobot("range_min_m: 1"),
            "robot.yaml:1:1: range_min_m: unknown option here; did you mean 'laser.range_min_m'?");
}

TEST(Loader, NamesWhatAnOptionIsCalledNow) {
  EXPECT_EQ(ComplaintOfRobot("scanner:\n  reach_m: 8\n  range_min_m: low\n"),
            "robot.yaml:1:1: scanner: is now called 'laser'\n"
            "robot.yaml:2:3: laser.reach_m: is now called 'laser.range_max_m'\n"
            "robot.yaml:3:16: laser.range_min_m: expected a number, got 'low'");
  EXPECT_EQ(ComplaintOfRobot("", {"scanner.reach_m=8"}),
            "--set scanner.reach_m: is now called 'laser.range_max_m'");
}

TEST(Loader, RefusesDuplicates) {
  EXPECT_EQ(ComplaintOfRobot("verbose: true\nmax_iterations: 2\nverbose: false\n"),
            "robot.yaml:3:1: verbose: given twice; first in line 1");
}

TEST(Loader, ChecksFieldsAgainstEachOther) {
  EXPECT_EQ(ComplaintOfRobot("laser:\n  range_min_m: 50\n"),
            "robot.yaml:2:16: laser.range_min_m: must be below range_max_m");
  EXPECT_EQ(ComplaintOfRobot("laser:\n  range_max_m: 0.05\n"),
            "robot.yaml:2:16: laser.range_min_m: must be below range_max_m")
      << "found at what was given, since range_min_m was not";
  EXPECT_EQ(ComplaintOfRobot("", {"laser.range_min_m=50"}),
            "--set laser.range_min_m: laser.range_min_m: must be below range_max_m");
}

TEST(Loader, RefusesGroupsForValuesAndValuesForGroups) {
  EXPECT_EQ(ComplaintOfRobot("laser: 3"),
            "robot.yaml:1:8: laser: expected a group of options (key: value, indented below)");
  EXPECT_EQ(ComplaintOfRobot("- a\n- b\n"),
            "robot.yaml:1:1: expected a group of options (key: value, indented below)");
  EXPECT_EQ(ComplaintOfRobot("verbose: {a: b}"),
            "robot.yaml:1:10: verbose: expected true or false, got a group");
}

TEST(Loader, LocatesSyntaxErrors) {
  EXPECT_EQ(ComplaintOfRobot("laser:\n  range_max_m: [1\nverbose: true\n").substr(0, 13), "robot.yaml:3:");
  EXPECT_EQ(ComplaintOfRobot("a: 1\n\tb: 2\n").substr(0, 13), "robot.yaml:2:");
}

TEST(Loader, RefusesWhatMakesSmallFilesLargeDeepOrSurprising) {
  EXPECT_EQ(ComplaintOfRobot("verbose: &a true\n"),
            "robot.yaml:1:10: anchors and aliases are not supported");
  EXPECT_EQ(ComplaintOfRobot("verbose: !!bool true\n"), "robot.yaml:1:10: tags are not supported");
  EXPECT_EQ(ComplaintOfRobot("verbose: true\n---\nverbose: false\n"),
            "robot.yaml:3:1: a second document begins; only one is read");
  const std::string deep = "a: " + std::string(100000, '[');
  EXPECT_NE(ComplaintOfRobot(deep).find("nested too deeply"), std::string::npos);
}

TEST(Loader, ChecksSettingsAsItChecksFiles) {
  const RobotOptions options =
      LoadRobot("max_iterations: 7", {"max_iterations=8", "laser.field_of_view_deg=180"});
  EXPECT_EQ(options.max_iterations, 8);
  EXPECT_DOUBLE_EQ(options.laser.field_of_view_rad, std::numbers::pi);
  EXPECT_EQ(ComplaintOfRobot("verbose: maybe", {"max_iterations=0", "max_iterations"}),
            "robot.yaml:1:10: verbose: expected true or false, got 'maybe'\n"
            "--set max_iterations: must be between 1 and 1000, got 0\n"
            "--set max_iterations: expected key=value");
  EXPECT_EQ(ComplaintOfRobot("", {"laser.range_mix_m=1"}),
            "--set laser.range_mix_m: unknown option; did you mean 'range_min_m'?");
  EXPECT_EQ(ComplaintOfRobot("", {"verbose.x=1"}), "--set verbose.x: 'verbose' is no group of options");
  EXPECT_EQ(ComplaintOfRobot("", {"laser=1"}), "--set laser: is a group of options; set one of them");
  EXPECT_EQ(ComplaintOfRobot("", {"verbose="}), "--set verbose: expected true or false, got nothing");
}

}  // namespace
}  // namespace qwsm::config
