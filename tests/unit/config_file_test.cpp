// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "service/config/options_io.hpp"
#include "tests/support/robot_options.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::config {
namespace {

namespace fs = std::filesystem;
using test::RobotOptions;

class ConfigFile : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_.path() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

  static std::string Complaint(const fs::path& file) {
    try {
      LoadOptions<RobotOptions>({.file = file, .settings = {}});
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }

  test::TemporaryFolder folder_;
};

TEST_F(ConfigFile, IsLaidOverItsBase) {
  Write("base.yaml", "max_iterations: 5\nverbose: true\n");
  const fs::path file = Write("site/robot.yaml", "max_iterations: 6\nbase: ../base.yaml\n");
  const auto options =
      LoadOptions<RobotOptions>({.file = file, .settings = {"laser.range_min_m=0.2"}});
  EXPECT_EQ(options.max_iterations, 6) << "the base is read first, wherever it is named";
  EXPECT_TRUE(options.verbose);
  EXPECT_EQ(options.laser.range_min_m, 0.2);
}

TEST_F(ConfigFile, LocatesProblemsInTheFileThatHasThem) {
  const fs::path base = Write("base.yaml", "verbos: true\n");
  const fs::path file = Write("robot.yaml", "base: base.yaml\nmax_iterations: none\n");
  EXPECT_EQ(Complaint(file),
            file.string() + ":2:17: max_iterations: expected a whole number, got 'none'\n" +
                base.string() + ":1:1: verbos: unknown option; did you mean 'verbose'?");
}

TEST_F(ConfigFile, RefusesToIncludeItself) {
  Write("a.yaml", "base: b.yaml\n");
  const fs::path b = Write("b.yaml", "base: ./a.yaml\n");
  const std::string complaint = Complaint(b);
  EXPECT_NE(complaint.find("a.yaml:1:7: base: "), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("includes itself"), std::string::npos) << complaint;
}

TEST_F(ConfigFile, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(
      Complaint(folder_.path() / "none.yaml"),
      (folder_.path() / "none.yaml").string() + ": cannot be opened: No such file or directory");
  EXPECT_EQ(Complaint(folder_.path()),
            folder_.path().string() + ": is a directory, not a YAML file");
  const fs::path file = Write("robot.yaml", "base: none.yaml\n");
  EXPECT_EQ(Complaint(file),
            file.string() + ":1:7: base: '" + (folder_.path() / "none.yaml").string() +
                "' cannot be opened: No such file or directory");
}

TEST_F(ConfigFile, RefusesHugeFiles) {
  EXPECT_NE(Complaint("/dev/zero").find("larger than 1 MiB"), std::string::npos);
}

TEST_F(ConfigFile, DumpReadsBackExactly) {
  RobotOptions options;
  options.laser.range_min_m = 0.1 + 0.2;
  options.laser.field_of_view_rad = 0.002;
  options.drive = test::Drive::kDifferential;
  const fs::path file = Write("robot.yaml", DumpOptions(options));
  const auto read = LoadOptions<RobotOptions>({.file = file, .settings = {}});
  EXPECT_EQ(read.laser.range_min_m, options.laser.range_min_m);
  EXPECT_EQ(read.laser.field_of_view_rad, options.laser.field_of_view_rad);
  EXPECT_EQ(read.drive, options.drive);
  EXPECT_EQ(DumpOptions(read), DumpOptions(options));
}

TEST_F(ConfigFile, DumpExplainsEveryOption) {
  EXPECT_EQ(DumpOptions(RobotOptions{}),
            "# upper bound (between 1 and 1000)\n"
            "max_iterations: 40\n"
            "# say more (true | false)\n"
            "verbose: false\n"
            "# how it is pushed (skid | differential)\n"
            "drive: skid\n"
            "# the front scanner\n"
            "laser:\n"
            "  # readings below are dropped (at least 0)\n"
            "  range_min_m: 0.1\n"
            "  # readings above are misses (at most 1000)\n"
            "  range_max_m: 30\n"
            "  # of one sweep (between 0 and 360)\n"
            "  field_of_view_deg: 180\n");
}

TEST_F(ConfigFile, DescriptionIsATable) {
  EXPECT_EQ(
      DescribeOptions<RobotOptions>(),
      "option                   default  unit  allowed              what it does\n"
      "max_iterations           40             between 1 and 1000   upper bound\n"
      "verbose                  false          true | false         say more\n"
      "drive                    skid           skid | differential  how it is pushed\n"
      "laser.range_min_m        0.1      m     at least 0           readings below are dropped\n"
      "laser.range_max_m        30       m     at most 1000         readings above are misses\n"
      "laser.field_of_view_deg  180      deg   between 0 and 360    of one sweep\n");
}

}  // namespace
}  // namespace qwsm::config
