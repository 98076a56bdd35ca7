// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "qwsm/logs/log_reader.hpp"
#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

using test::FailureOf;
using test::ReadLogText;

constexpr const char* kOdometry = "ODOM 1 2 3 0 0 0 1.0 host 1.0\n";

TEST(OpenLog, SaysWhatItExpectedOfAFileThatIsNoLog) {
  EXPECT_EQ(FailureOf(""), "test.log: the file is empty");
  EXPECT_EQ(
      FailureOf("hello world\n"),
      "test.log: this is no robot log: none of its first 1 lines is a message of CARMEN "
      "(FLASER, ODOM, ...), Player or DP-SLAM, and it is no bag of ROS (.bag, .mcap, .db3 or a "
      "folder)");
  EXPECT_NE(FailureOf("# only a comment\n"), "");
  EXPECT_NE(FailureOf(std::string(100'000, '\0')), "");
}

TEST(OpenLog, NamesTheFileItCannotOpen) {
  try {
    OpenLog(std::filesystem::path("no/such/file.log"));
    FAIL() << "did not throw";
  } catch (const LogError& error) {
    EXPECT_STREQ(error.what(), "no/such/file.log: cannot be opened: No such file or directory");
  }
  EXPECT_THROW(OpenLog(std::filesystem::temp_directory_path()), LogError);
}

TEST(OpenLog, RecognisesTheFormatBehindForeignLines) {
  EXPECT_EQ(ReadLogText(std::string("garbage in front\n\n# comment\n") + kOdometry).report.format,
            "CARMEN");
}

TEST(OpenLog, ReadsWindowsLineEndsAndALastLineWithoutEnd) {
  const std::string line = "ODOM 1 2 3 0 0 0 1.0 host 1.0";
  EXPECT_EQ(ReadLogText("\xef\xbb\xbf" + line + "\r\n" + line).odometry.size(), 2U);
}

TEST(OpenLog, ReadsOverALineWithoutEnd) {
  const std::string log = std::string(kOdometry) + std::string(5'000'000, 'x') + "\n" + kOdometry;
  const test::LogContent content = ReadLogText(log);
  EXPECT_EQ(content.odometry.size(), 2U);
  ASSERT_EQ(content.report.faults.size(), 1U);
  EXPECT_TRUE(content.report.faults[0].what.starts_with("line: the line is longer than 4 MiB"));
}

TEST(OpenLog, TellsWhatOfItsOptionsCountsForBagsOnly) {
  std::string told;
  LogOptions options;
  options.on_fault = [&told](const std::string& fault) { told += fault + "\n"; };
  ReadLogText(kOdometry, options);
  EXPECT_EQ(told, "");
  options.scan_topics = {"/scan"};
  options.stamp_offset_s = 0.3;
  ReadLogText(kOdometry, options);
  EXPECT_EQ(told, "test.log: left out, as it counts for bags only: log.scan, log.stamp_offset_s\n");
}

TEST(OpenLog, KnowsHowFarItHasRead) {
  const auto path = std::filesystem::path(testing::TempDir()) / "progress.log";
  std::ofstream(path) << kOdometry << kOdometry;
  const auto reader = OpenLog(path);
  while (reader->Next()) {
  }
  EXPECT_EQ(reader->progress().bytes_total, std::filesystem::file_size(path));
  EXPECT_EQ(reader->progress().bytes_read, reader->progress().bytes_total);
  std::filesystem::remove(path);
}

TEST(OpenLog, BoundsTheNamesOfUnknownMessages) {
  std::string log = kOdometry;
  for (int i = 0; i < 1000; ++i) log += "UNKNOWN" + std::to_string(i) + "\n";
  const auto& unknown = ReadLogText(log).report.unknown_messages;
  EXPECT_LE(unknown.size(), 51U);
  EXPECT_EQ(unknown.at("(others)"), 950U);
}

}  // namespace
}  // namespace qwsm::io
