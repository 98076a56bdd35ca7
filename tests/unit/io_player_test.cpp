// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;
using test::LogContent;
using test::ReadLogText;

using std::numbers::pi;

TEST(PlayerLog, ReadsFilesOfPlayerOne) {
  const LogContent log = ReadLogText(
      "## Player version 1.5 \n"
      "## File version 0.1.0 \n"
      "1045869313.284 robot 6665 sync 00 1045869313.284 \n"
      "1045869313.300 robot 6665 position 00 1045869313.200 +01.000 -02.000 +0.500 +00.000 +00.000 "
      "+00.000 0\n"
      "1045869313.384 robot 6665 laser 00 1045869313.250 -1.5708 +1.5708 +0.7854 0005 1.000  0 "
      "2.000  0 3.000  0 4.000  0 8.191  1 \n"
      "1045869313.484 robot 6665 position 00 1045869313.300 +03.000 -02.000 +0.500 +00.000 +00.000 "
      "+00.000 0\n");
  EXPECT_EQ(log.report.format, "Player");
  EXPECT_TRUE(log.report.faults.empty());
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[0].stamp, 1045869313200ms);
  ASSERT_EQ(log.scans.size(), 1U);
  const ScanReading& reading = log.scans[0];
  EXPECT_EQ(reading.laser, "laser:0");
  EXPECT_EQ(reading.scan.stamp, 1045869313250ms);
  EXPECT_EQ(reading.scan.ranges_m, (std::vector{1.0F, 2.0F, 3.0F, 4.0F, 8.191F}));
  EXPECT_NEAR(reading.scan.geometry.Bearing(0), -pi / 2.0, 1e-4);
  EXPECT_NEAR(reading.scan.geometry.Bearing(4), pi / 2.0, 1e-4);
  ASSERT_TRUE(reading.T_odom_robot.has_value());
  EXPECT_NEAR(reading.T_odom_robot->x_m, 2.0, 1e-9);
}

TEST(PlayerLog, ReadsFilesOfPlayerTwo) {
  const LogContent log = ReadLogText(
      "## Player version 2.1.1 \n"
      "0000000100.000 16777343 6665 laser 00 004 001 +00.200 -00.100   0.000   0.150   0.150\n"
      "0000000101.000 16777343 6665 position2d 00 004 001 +00.000 +00.000 +0.000 +00.450 +00.380\n"
      "0000000102.000 16777343 6665 position2d 00 001 001 +01.000 +02.000 +0.100 +00.000 +00.000 "
      "+00.000 0\n"
      "0000000102.050 16777343 6665 laser 00 001 001 0007 -1.5708 +1.5708 +1.57079633 +08.0000 "
      "0003 "
      "1.000  0 2.000  0 3.000  0 \n"
      "0000000102.100 16777343 6665 laser 00 001 002 0008 +01.500 +02.000 +00.100 -1.5708 +1.5708 "
      "+1.57079633 +08.0000 0003 1.000  0 2.000  0 3.000  0 \n");
  EXPECT_TRUE(log.report.faults.empty());
  EXPECT_EQ(log.report.other_messages, 2U);
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.scans[0].scan.geometry.T_robot_laser, (Pose2{0.2, -0.1, 0.0}));
  EXPECT_EQ(log.scans[0].scan.geometry.range_max_m, 8.0F);
  EXPECT_EQ(log.scans[0].T_odom_robot, (Pose2{1.0, 2.0, 0.1}));
  EXPECT_EQ(log.scans[1].T_odom_robot, (Pose2{1.5, 2.0, 0.1}));
}

TEST(PlayerLog, ReadsBeamsWithTheirBearings) {
  const LogContent log = ReadLogText(
      "1075329039.144 intel0 7000 position 01 1075329039.034 +01.000 +00.000 -0.000 +0.000 +0.000 "
      "+0.000\n"
      "1075329039.148 intel0 7000 laser 00 1075329039.034 0.620 -1.571 0 0.630 0.000 0 8.183 1.571 "
      "1\n");
  EXPECT_TRUE(log.report.faults.empty());
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.scans[0].scan.ranges_m, (std::vector{0.62F, 0.63F, 8.183F}));
  EXPECT_NEAR(log.scans[0].scan.geometry.Bearing(0), -pi / 2.0, 1e-3);
  EXPECT_NEAR(log.scans[0].scan.geometry.Bearing(2), pi / 2.0, 1e-3);
  EXPECT_EQ(log.scans[0].T_odom_robot, (Pose2{1.0, 0.0, 0.0}));
}

TEST(PlayerLog, ReadsLinesThatBeginWithTheInterface) {
  const LogContent log = ReadLogText(
      "sync 00 1037838567.000\n"
      "position 00 1037838567.100 1.0 2.0 0.5 0.0 0.0 0.0\n"
      "laser 00 1037838567.200 1.0 -1.571 0 2.0 0.0 0 3.0 1.571 0\n");
  EXPECT_EQ(log.report.format, "Player");
  EXPECT_TRUE(log.report.faults.empty());
  EXPECT_EQ(log.odometry.at(0).stamp, 1037838567100ms);
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.scans[0].scan.stamp, 1037838567200ms);
  EXPECT_EQ(log.scans[0].T_odom_robot, (Pose2{1.0, 2.0, 0.5}));
}

TEST(PlayerLog, RefusesBearingsThatAreNoSweep) {
  const LogContent log =
      ReadLogText("laser 00 1.0 1.0 -1.571 0 2.0 1.5 0 3.0 1.571 0\nlaser 00 1.0 1.0 -1.571\n");
  ASSERT_EQ(log.report.faults.size(), 2U);
  EXPECT_TRUE(log.report.faults[0].what.starts_with("laser: the stated bearings are no sweep"));
  EXPECT_TRUE(log.report.faults[1].what.starts_with("laser: the line ends early"));
}

TEST(PlayerLog, ReadsTheTruePoseOfASimulator) {
  const LogContent log =
      ReadLogText("0000000001.000 host 6665 truth 00 0000000000.900 +01.000 +02.000 +0.500\n");
  ASSERT_EQ(log.true_poses.size(), 1U);
  EXPECT_EQ(log.true_poses[0].stamp, 900ms);
  EXPECT_EQ(log.true_poses[0].T_world_robot, (Pose2{1.0, 2.0, 0.5}));
}

TEST(PlayerLog, FollowsTheFirstOfSeveralRobots) {
  const std::string scan = " -1.5708 +1.5708 +1.57079633 0003 1.0 0 2.0 0 3.0 0\n";
  const LogContent log = ReadLogText(
      "1.0 ant 6665 position 00 1.0 +1.0 +0.0 +0.0 +0.0 +0.0 +0.0 0\n"
      "1.0 bee 6665 position 00 1.0 +9.0 +0.0 +0.0 +0.0 +0.0 +0.0 0\n"
      "1.1 bee 6665 laser 00 1.1" +
      scan + "1.1 ant 6665 laser 00 1.1" + scan + "1.1 ant 6665 laser 01 1.1" + scan);
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.scans[0].T_odom_robot, (Pose2{1.0, 0.0, 0.0}));
  EXPECT_EQ(log.odometry.size(), 1U);
  EXPECT_EQ(log.report.other_scans, 2U);
}

TEST(PlayerLog, SaysWhatIsWrongWithALine) {
  const LogContent log = ReadLogText(
      "## Player version 1.5 \n"
      "1.0 host 6665 laser 00 1.0 -1.5708 +1.5708 +1.57079633 0003 1.0 0 2.0 0\n"
      "1.0 host 6665 laser 00 1.0 -1.5708 +1.5708 +1.57079633 2000000 1.0 0 2.0 0\n"
      "1.0 host 6665 position 00 1.0 one two three\n"
      "1.0 host 6665 teleport 00 1.0 1 2 3\n"
      "nonsense\n");
  ASSERT_EQ(log.report.faults.size(), 4U);
  EXPECT_TRUE(log.report.faults[0].what.starts_with("laser: the line ends early"));
  EXPECT_TRUE(log.report.faults[1].what.starts_with("laser: the count of readings"));
  EXPECT_TRUE(log.report.faults[2].what.starts_with("position: a field is not a number"));
  EXPECT_TRUE(log.report.faults[3].what.starts_with("line: "));
  EXPECT_EQ(log.report.unknown_messages.at("teleport"), 1U);
}

}  // namespace
}  // namespace qwsm::io
