// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "qwsm/logs/log_reader.hpp"

namespace qwsm::test {

/// Everything a log says, and the report of its reader.
struct LogContent {
  std::vector<io::LogRecord> records;
  std::vector<io::ScanReading> scans;
  std::vector<io::OdometryReading> odometry;
  std::vector<io::TruePoseReading> true_poses;
  std::vector<ImuReading> imu;
  io::LogReport report;
};

inline LogContent ReadAll(io::LogReader& reader) {
  LogContent content;
  while (const std::optional<io::LogRecord> record = reader.Next()) {
    content.records.push_back(*record);
    if (const auto* scan = std::get_if<io::ScanReading>(&*record)) content.scans.push_back(*scan);
    if (const auto* odometry = std::get_if<io::OdometryReading>(&*record)) {
      content.odometry.push_back(*odometry);
    }
    if (const auto* pose = std::get_if<io::TruePoseReading>(&*record)) {
      content.true_poses.push_back(*pose);
    }
    if (const auto* imu = std::get_if<ImuReading>(&*record)) content.imu.push_back(*imu);
  }
  content.report = reader.report();
  return content;
}

/// Reads a log given as text; messages call it "test.log".
inline LogContent ReadLogText(const std::string& text, const io::LogOptions& options = {}) {
  std::istringstream stream(text);
  return ReadAll(*io::OpenLog(stream, "test.log", options));
}

/// What reading the text to its end fails with; empty if it does not.
inline std::string FailureOf(const std::string& text, const io::LogOptions& options = {}) {
  try {
    ReadLogText(text, options);
  } catch (const io::LogError& error) {
    return error.what();
  }
  return "";
}

}  // namespace qwsm::test
