// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "service/io/log_reader.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

constexpr double kPi = std::numbers::pi;

/// Everything a log says, and the report of its reader.
struct ReadLog {
  std::vector<ScanReading> scans;
  std::vector<OdometryReading> odometry;
  std::vector<TruePoseReading> true_poses;
  LogReport report;
};

ReadLog Read(const std::string& text, const LogOptions& options = {}) {
  std::istringstream stream(text);
  const auto reader = OpenLog(stream, "test.log", options);
  ReadLog log;
  while (const std::optional<LogRecord> record = reader->Next()) {
    if (const auto* scan = std::get_if<ScanReading>(&*record)) log.scans.push_back(*scan);
    if (const auto* odometry = std::get_if<OdometryReading>(&*record)) {
      log.odometry.push_back(*odometry);
    }
    if (const auto* pose = std::get_if<TruePoseReading>(&*record)) log.true_poses.push_back(*pose);
  }
  log.report = reader->report();
  return log;
}

TEST(CarmenLog, ReadsOdometryWithItsExactStamp) {
  const ReadLog log = Read("ODOM 1.5 -2.25 3 0.1 0.2 0.3 976052857.337531 host 0.000001\n");
  ASSERT_EQ(log.odometry.size(), 1U);
  EXPECT_EQ(log.odometry[0].stamp, 976052857337531us);
  EXPECT_EQ(log.odometry[0].T_odom_robot, (Pose2{1.5, -2.25, 3.0}));
  EXPECT_EQ(log.report.format, "CARMEN");
}

TEST(CarmenLog, ReadsAFlaserLineWithTheOdometryAtItsEnd) {
  const ReadLog log = Read("FLASER 3 1.5 2.25 81.91 1 2 0.5 1 2 0.5 10.25 host 0.5\n");
  ASSERT_EQ(log.scans.size(), 1U);
  const ScanReading& reading = log.scans[0];
  EXPECT_EQ(reading.laser, "front");
  EXPECT_EQ(reading.scan.stamp, 10250ms);
  EXPECT_EQ(reading.scan.ranges_m, (std::vector{1.5F, 2.25F, 81.91F}));
  EXPECT_EQ(reading.T_odom_robot, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_NEAR(reading.scan.geometry.Bearing(0), -kPi / 2.0, 1e-6);
  EXPECT_NEAR(reading.scan.geometry.Bearing(2), kPi / 2.0, 1e-6);
}

TEST(CarmenLog, SkipsAndCountsMalformedLinesByKind) {
  std::vector<std::string> messages;
  LogOptions options;
  options.on_fault = [&](const std::string& message) { messages.push_back(message); };
  const ReadLog log = Read(
      "# CARMEN Logfile\n"
      "ODOM 1 2 3 0 0 0 1.0 host 1.0\n"
      "ODOM 1 2 x 0 0 0 1.0 host 1.0\n"
      "ODOM 1 2 1.21.3 0 0 0 1.0 host 1.0\n"
      "ODOM 1 2 3 0 0 0\n",
      options);
  EXPECT_EQ(log.odometry.size(), 1U);
  ASSERT_EQ(log.report.faults.size(), 2U);
  EXPECT_EQ(log.report.faults[0].count, 2U);
  EXPECT_EQ(log.report.faults[0].first_line, 3U);
  EXPECT_EQ(log.report.faults[1].first_line, 5U);
  EXPECT_EQ(log.report.malformed_lines(), 3U);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_TRUE(messages[0].starts_with("test.log:3: ODOM: a field is not a number"));
}

TEST(CarmenLog, StopsAtTheFirstMalformedLineWhenStrict) {
  std::istringstream stream("ODOM 1 2 3 0 0 0 1.0 host 1.0\nODOM 1 2\n");
  LogOptions options;
  options.strict = true;
  const auto reader = OpenLog(stream, "test.log", options);
  EXPECT_TRUE(reader->Next().has_value());
  try {
    reader->Next();
    FAIL() << "did not throw";
  } catch (const LogError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("test.log:2: ODOM: the line ends early"));
  }
}

TEST(OpenLog, SaysWhatItExpectedOfAFileThatIsNoLog) {
  std::istringstream stream("hello world\n");
  EXPECT_THROW(OpenLog(stream, "test.log"), LogError);
}

}  // namespace
}  // namespace qwsm::io
