// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;
using test::LogContent;
using test::ReadLogText;

TEST(DpslamLog, PairsOdometryWithSweepsAndMakesUpTheirTime) {
  const LogContent log = ReadLogText(
      "Odometry 1.0 2.0 0.5 \nLaser 3 1.0 2.0 8.183 \n"
      "Odometry 1.5 2.0 0.5 \nLaser 3 1.0 2.0 8.183 \n");
  EXPECT_EQ(log.report.format, "DP-SLAM");
  EXPECT_FALSE(log.report.has_stamps);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].scan.stamp, 0s);
  EXPECT_EQ(log.scans[1].scan.stamp, 100ms);
  EXPECT_EQ(log.odometry.at(1).stamp, 100ms);
  EXPECT_EQ(log.scans[1].T_odom_robot, (Pose2{1.5, 2.0, 0.5}));
  EXPECT_EQ(log.scans[1].scan.ranges_m, (std::vector{1.0F, 2.0F, 8.183F}));
}

TEST(DpslamLog, SaysWhatIsWrongWithALine) {
  const LogContent log = ReadLogText(
      "Odometry 1.0 2.0 0.5\nLaser 3 1.0 2.0\nLaser 2 1.0 2.0 3.0\nOdometry 1 2 3 4\nSonar "
      "3\n\x02\n");
  EXPECT_EQ(log.records.size(), 1U);
  ASSERT_EQ(log.report.faults.size(), 4U);
  EXPECT_TRUE(log.report.faults[0].what.starts_with("Laser: the line ends early"));
  EXPECT_TRUE(log.report.faults[1].what.starts_with("Laser: the line goes on"));
  EXPECT_TRUE(log.report.faults[2].what.starts_with("Odometry: the line goes on"));
  EXPECT_TRUE(log.report.faults[3].what.starts_with("line: the line is not text"));
  EXPECT_EQ(log.report.unknown_messages.at("Sonar"), 1U);
}

}  // namespace
}  // namespace qwsm::io
