// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "tests/support/bag_maker.hpp"
#include "tests/support/log_text.hpp"
#include "tests/support/temporary_folder.hpp"

/// A short drive in bags of all kinds.
namespace qwsm::io {

using test::LogContent;
using test::MadeMessage;
using test::Ros;

inline const Pose2 kMounting{0.2, -0.1, 0.5};

inline Timestamp At(int scan) {
  return std::chrono::seconds(1000) + scan * std::chrono::milliseconds(100);
}
inline Pose2 OdometryAt(int scan) { return {0.1 * scan, -0.05 * scan, 0.01 * scan}; }
inline std::vector<float> RangesAt(int scan) {
  return {1.0F + 0.5F * static_cast<float>(scan), 2.0F, 3.0F};
}

/// Four scans with odometry; where the laser sits comes last.
std::vector<MadeMessage> Drive(Ros ros);

class Bag : public testing::Test {
 protected:
  LogContent Read(const std::string& name, const LogOptions& options = {}) {
    LogOptions telling = options;
    telling.on_fault = [this](const std::string& fault) { told_ += fault + "\n"; };
    return test::ReadAll(*OpenLog(folder_.path() / name, telling));
  }
  LogContent ReadRos1(const std::vector<MadeMessage>& messages,
                      std::string_view compression = "none",
                      const LogOptions& options = {}) {
    test::WriteBytes(folder_.path() / "t.bag", test::Ros1BagOf(messages, compression));
    return Read("t.bag", options);
  }
  LogContent ReadMcap(const std::vector<MadeMessage>& messages,
                      std::string_view compression = "zstd",
                      const LogOptions& options = {}) {
    test::WriteBytes(folder_.path() / "t.mcap", test::McapOf(messages, compression));
    return Read("t.mcap", options);
  }
  std::string FailureOf(const std::function<void()>& action) {
    try {
      action();
    } catch (const LogError& error) {
      return error.what();
    }
    return "";
  }

  void ExpectDrive(const LogContent& log) {
    ASSERT_EQ(log.scans.size(), 4U);
    for (int i = 0; i < 4; ++i) {
      const ScanReading& reading = log.scans[static_cast<std::size_t>(i)];
      EXPECT_EQ(reading.scan.stamp, At(i));
      EXPECT_EQ(reading.T_odom_robot, OdometryAt(i));
      EXPECT_EQ(reading.scan.ranges_m, RangesAt(i));
      EXPECT_EQ(reading.scan.geometry.T_robot_laser, kMounting);
      EXPECT_EQ(reading.scan.geometry.first_bearing_rad, -1.0F);
    }
    EXPECT_EQ(log.odometry.size(), 4U);
    EXPECT_EQ(log.report.lines, 9U);
    EXPECT_TRUE(log.report.faults.empty());
  }

  test::TemporaryFolder folder_;
  std::string told_;
};

}  // namespace qwsm::io
