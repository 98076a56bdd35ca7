// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "qwsm/sensor/scan_limits.hpp"
#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;
using test::FailureOf;
using test::LogContent;
using test::ReadLogText;

using std::numbers::pi;

TEST(CarmenLog, ReadsOdometryWithItsExactStamp) {
  const LogContent log =
      ReadLogText("ODOM 1.5 -2.25 3 0.1 0.2 nan 976052857.337531 host 0.000001\n");
  ASSERT_EQ(log.odometry.size(), 1U);
  EXPECT_EQ(log.odometry[0].stamp, 976052857337531us);
  EXPECT_EQ(log.odometry[0].T_odom_robot, (Pose2{1.5, -2.25, 3.0}));
  EXPECT_EQ(log.report.format, "CARMEN");
}

TEST(CarmenLog, PassesOverPlacesThatAreNone) {
  const LogContent log = ReadLogText(
      "ODOM 1 2 0 0 0 0 1 host 1\n"
      "ODOM 1e9 2 0 0 0 0 2 host 2\n"
      "ODOM 1 -1e300 0 0 0 0 3 host 3\n"
      "ODOM 4000000 5500000 0 0 0 0 4 host 4\n"
      "PARAM robot_frontlaser_offset 1e9\n");
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[1].stamp, 4s);
  ASSERT_EQ(log.report.faults.size(), 2U);
  EXPECT_TRUE(log.report.faults[0].what.starts_with("ODOM: a position is more than 10000 km"));
  EXPECT_EQ(log.report.faults[0].count, 2U);
  EXPECT_EQ(log.report.faults[0].first_line, 2U);
  EXPECT_TRUE(log.report.faults[1].what.starts_with("PARAM: a position is more than 10000 km"));
}

TEST(CarmenLog, BelievesNoRangeMaximumThatNoLaserHas) {
  const LogContent log = ReadLogText(
      "ROBOTLASER1 0 -1.5 3.0 1.5 1e30 0.01 0 3 1.5 1e20 2.5 0 0 0 0 0 0 0 0 0 0 0 0 1 host 1\n");
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(ObjectionTo(log.scans[0].scan), "");
  EXPECT_EQ(StateOf(log.scans[0].scan.ranges_m[1], log.scans[0].scan.geometry), BeamState::kMiss);
}

TEST(CarmenLog, ReadsAFlaserLineWithTheOdometryAtItsEnd) {
  const LogContent log = ReadLogText("FLASER 3 1.5 2.25 81.91 1 2 0.5 1 2 0.5 10.25 host 0.5\n");
  ASSERT_EQ(log.scans.size(), 1U);
  const ScanReading& reading = log.scans[0];
  EXPECT_EQ(reading.laser, "front");
  EXPECT_EQ(reading.scan.stamp, 10250ms);
  EXPECT_EQ(reading.scan.ranges_m, (std::vector{1.5F, 2.25F, 81.91F}));
  EXPECT_EQ(reading.T_odom_robot, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_NEAR(reading.scan.geometry.Bearing(0), -pi / 2.0, 1e-6);
  EXPECT_NEAR(reading.scan.geometry.Bearing(2), pi / 2.0, 1e-6);
  EXPECT_EQ(reading.scan.geometry.T_robot_laser, Pose2{});
}

std::string FlaserOf(std::size_t readings) {
  std::string line = "FLASER " + std::to_string(readings);
  for (std::size_t i = 0; i < readings; ++i) line += " 1.0";
  return line + " 0 0 0 0 0 0 1.0 host 1.0\n";
}

TEST(CarmenLog, KnowsScannersByTheirCountOfReadings) {
  const auto expect = [](std::size_t readings, double first_deg, double step_deg) {
    SCOPED_TRACE(readings);
    const LogContent log = ReadLogText(FlaserOf(readings));
    ASSERT_EQ(log.scans.size(), 1U);
    const LaserGeometry& geometry = log.scans[0].scan.geometry;
    EXPECT_NEAR(RadiansToDegrees(geometry.Bearing(0)), first_deg, 1e-4);
    EXPECT_NEAR(RadiansToDegrees(geometry.Bearing(1) - geometry.Bearing(0)), step_deg, 1e-4);
  };
  expect(180, -90.0, 1.0);
  expect(181, -90.0, 1.0);
  expect(360, -90.0, 0.5);
  expect(361, -90.0, 0.5);
  expect(401, -50.0, 0.25);
  expect(541, -135.0, 0.5);
  expect(1081, -135.0, 0.25);
  expect(682, -340.5 * 360.0 / 1024.0, 360.0 / 1024.0);
  expect(91, -90.0, 2.0);
}

TEST(CarmenLog, TakesTheFieldOfViewItIsTold) {
  LogOptions options;
  options.field_of_view_rad = 2.0 * pi / 3.0;
  const LogContent log = ReadLogText(FlaserOf(121), options);
  EXPECT_NEAR(log.scans.at(0).scan.geometry.Bearing(0), -pi / 3.0, 1e-6);
  EXPECT_NEAR(log.scans.at(0).scan.geometry.Bearing(120), pi / 3.0, 1e-6);
}

TEST(CarmenLog, ReadsARobotlaserLineWithBearingsRangeAndMounting) {
  const std::string poses = " 1.1 2.0 0.0 1.0 2.0 0.0";
  for (const std::string tail : {" 0 0 0 0 10.5 host 0.5\n", " 0 0 0 0 0 10.5 host 0.5\n"}) {
    SCOPED_TRACE(tail);
    const LogContent log = ReadLogText(
        "ROBOTLASER1 0 -1.570796 3.141593 1.570796 30.0 0.01 0 3 1 2 3 2 9 9" + poses + tail);
    ASSERT_EQ(log.scans.size(), 1U);
    const ScanReading& reading = log.scans[0];
    EXPECT_EQ(reading.scan.stamp, 10500ms);
    EXPECT_EQ(reading.scan.ranges_m, (std::vector{1.0F, 2.0F, 3.0F}));
    EXPECT_EQ(reading.scan.geometry.range_max_m, 30.0F);
    EXPECT_NEAR(reading.scan.geometry.Bearing(2), pi / 2.0, 1e-5);
    EXPECT_EQ(reading.T_odom_robot, (Pose2{1.0, 2.0, 0.0}));
    EXPECT_EQ(reading.scan.geometry.T_robot_laser, (Pose2{0.1, 0.0, 0.0}));
  }
}

TEST(CarmenLog, TakesTheMountingFromParameters) {
  const LogContent log = ReadLogText(
      "PARAM robot_frontlaser_offset 0.35 nohost 0\n"
      "PARAM robot_frontlaser_side_offset -0.05 nohost 0\n"
      "PARAM robot_frontlaser_angular_offset 0.1 nohost 0\n"
      "PARAM robot_length 0.8 nohost 0\n"
      "FLASER 1 2.0 5 5 1 0 0 0 1.0 host 1.0\n");
  EXPECT_EQ(log.scans.at(0).scan.geometry.T_robot_laser, (Pose2{0.35, -0.05, 0.1}));
  EXPECT_EQ(log.report.other_messages, 4U);
}

TEST(CarmenLog, TakesTheMountingFromPosesThatDifferByAConstant) {
  std::string recorded;
  std::string corrected;
  for (int i = 0; i < 50; ++i) {
    const Pose2 T_odom_robot{0.1 * i, 0.02 * i * i, 0.05 * i};
    const auto line = [&](const Pose2& T_odom_laser) {
      std::ostringstream text;
      text << "FLASER 1 2.0 " << T_odom_laser.x_m << ' ' << T_odom_laser.y_m << ' '
           << T_odom_laser.theta_rad << ' ' << T_odom_robot.x_m << ' ' << T_odom_robot.y_m << ' '
           << T_odom_robot.theta_rad << ' ' << i << ".5 host 0\n";
      return text.str();
    };
    recorded += line(T_odom_robot * Pose2{0.25, 0.0, 0.0});
    corrected += line(Pose2{0.01 * i, 0.0, 0.002 * i} * T_odom_robot);
  }
  EXPECT_EQ(ReadLogText(recorded).scans.at(0).scan.geometry.T_robot_laser.x_m, 0.25);
  EXPECT_EQ(ReadLogText(corrected).scans.at(0).scan.geometry.T_robot_laser, Pose2{});
}

TEST(CarmenLog, ReadsTheTruePoseOfASimulator) {
  const LogContent log = ReadLogText("TRUEPOS 1 2 0.5 1.1 2.1 0.6 10.5 host 0.5\n");
  ASSERT_EQ(log.true_poses.size(), 1U);
  EXPECT_EQ(log.true_poses[0].T_world_robot, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(log.true_poses[0].T_odom_robot, (Pose2{1.1, 2.1, 0.6}));
}

constexpr const char* kThreeLasers =
    "ODOM 0 0 0 0 0 0 1.0 host 0\n"
    "RAWLASER1 0 -1.5 3 1.5 8 0.01 0 3 1 1 1 0 1.5 host 0\n"
    "RAWLASER2 0 -1.5 3 1.5 8 0.01 0 3 2 2 2 0 1.5 host 0\n"
    "RAWLASER3 0 -1.5 3 1.5 8 0.01 0 3 3 3 3 0 1.5 host 0\n"
    "ROBOTLASER1 0 -1.5 3 1.5 8 0.01 0 3 1 1 1 0 0 0 0 0 0 0 0 0 0 0 1.5 host 0\n"
    "ODOM 1 0 0 0 0 0 2.0 host 0\n";

TEST(CarmenLog, TakesTheFrontLaserAndEachSweepOnce) {
  const LogContent log = ReadLogText(kThreeLasers);
  ASSERT_EQ(log.scans.size(), 1U);
  EXPECT_EQ(log.scans[0].laser, "front");
  EXPECT_EQ(log.scans[0].T_odom_robot, (Pose2{0.0, 0.0, 0.0}));  // As ROBOTLASER1 says.
  EXPECT_EQ(log.report.other_scans, 3U);
}

TEST(CarmenLog, TakesTheLasersThatAreAskedFor) {
  LogOptions options;
  options.laser = "all";
  const LogContent all = ReadLogText(kThreeLasers, options);
  ASSERT_EQ(all.scans.size(), 3U);
  EXPECT_EQ(all.scans[0].laser, "rear");
  EXPECT_EQ(all.scans[1].laser, "laser3");
  EXPECT_EQ(all.scans[2].laser, "front");
  options.laser = "rear";
  EXPECT_EQ(ReadLogText(kThreeLasers, options).scans.at(0).scan.ranges_m[0], 2.0F);
  options.laser = "RAWLASER1";
  EXPECT_EQ(ReadLogText(kThreeLasers, options).scans.at(0).T_odom_robot, (Pose2{0.5, 0.0, 0.0}));
  options.laser = "roof";
  EXPECT_EQ(FailureOf(kThreeLasers, options),
            "test.log: no laser or message 'roof' in this log, which has 'front' (RAWLASER1), "
            "'front' (ROBOTLASER1), 'laser3' (RAWLASER3), 'rear' (RAWLASER2)");
}

TEST(CarmenLog, InterpolatesOdometryForRawSweeps) {
  const std::string sweep = "RAWLASER1 0 -1.5 3 1.5 8 0.01 0 3 1 1 1 0 ";
  const LogContent log = ReadLogText("ODOM 0 0 3.1 0 0 0 1.0 host 0\n" +   //
                                     sweep + "1.25 host 0\n" +             // Between two readings,
                                     "ODOM 4 8 -3.1 0 0 0 2.0 host 0\n" +  //
                                     sweep + "2.1 host 0\n" +  // a moment after the last one,
                                     sweep + "9.0 host 0\n");  // and long after.
  ASSERT_EQ(log.scans.size(), 3U);
  ASSERT_TRUE(log.scans[0].T_odom_robot.has_value());
  EXPECT_DOUBLE_EQ(log.scans[0].T_odom_robot->x_m, 1.0);
  EXPECT_DOUBLE_EQ(log.scans[0].T_odom_robot->y_m, 2.0);
  EXPECT_NEAR(log.scans[0].T_odom_robot->theta_rad, 3.1 + 0.25 * (2.0 * pi - 6.2), 1e-12);
  EXPECT_EQ(log.scans[1].T_odom_robot, (Pose2{4.0, 8.0, -3.1}));
  EXPECT_FALSE(log.scans[2].T_odom_robot.has_value());
}

TEST(CarmenLog, KeepsTheOrderOfTheFileWhateverTheStamps) {
  const LogContent log = ReadLogText(
      "ODOM 1 0 0 0 0 0 5.0 host 0\n"
      "FLASER 1 2.0 0 0 0 0 0 0 4.0 host 1.0\n"
      "FLASER 1 3.0 0 0 0 0 0 0 4.0 host 1.0\n"
      "ODOM 2 0 0 0 0 0 3.0 host 0\n");
  ASSERT_EQ(log.records.size(), 4U);
  EXPECT_EQ(std::get<OdometryReading>(log.records[0]).stamp, 5s);
  EXPECT_EQ(std::get<ScanReading>(log.records[1]).scan.ranges_m[0], 2.0F);
  EXPECT_EQ(std::get<ScanReading>(log.records[2]).scan.ranges_m[0], 3.0F);
  EXPECT_EQ(std::get<OdometryReading>(log.records[3]).stamp, 3s);
}

TEST(CarmenLog, TakesTheLoggersTimeWhereTheOtherWasNeverSet) {
  EXPECT_EQ(ReadLogText("ODOM 0 0 0 0 0 0 0 host 7.5\n").odometry.at(0).stamp, 7500ms);
  EXPECT_EQ(ReadLogText("ODOM 0 0 0 0 0 0 3 host\n").odometry.at(0).stamp, 3s);
}

TEST(CarmenLog, IgnoresKnownMessagesAndCountsUnknownOnes) {
  const LogContent log = ReadLogText(
      "# a comment\n\nSYNC tag 1 host 1\nNMEAGGA 1 2 3\nODOM 0 0 0 0 0 0 1 h 1\nWARP 9\nWARP 8\n");
  EXPECT_EQ(log.report.other_messages, 2U);
  EXPECT_EQ(log.report.unknown_messages.size(), 1U);
  EXPECT_EQ(log.report.unknown_messages.at("WARP"), 2U);
  EXPECT_TRUE(log.report.faults.empty());
}

struct FaultyLine {
  const char* line;
  const char* what;
};

TEST(CarmenLog, SaysWhatIsWrongWithALine) {
  const std::string many(300'000, '1');
  const FaultyLine faulty_lines[] = {
      {"ODOM 1 2\n", "ODOM: the line ends early"},
      {"ODOM 1 2 x 0 0 0 1.0 host 1.0\n", "ODOM: a field is not a number"},
      {"ODOM 1 2 1.21.3 0 0 0 1.0 host 1.0\n", "ODOM: a field is not a number"},
      {"ODOM 1 2 nan 0 0 0 1.0 host 1.0\n", "ODOM: a pose or an angle is not finite"},
      {"ODOM 1 2 3 0 0 0 nan host 1.0\n", "ODOM: the time stamp is missing or absurd"},
      {"ODOM 1 2 3 0 0 0 -1.0 host 1.0\n", "ODOM: the time stamp is missing or absurd"},
      {"ODOM 1 2 3 0 0 0 1e30 host 1.0\n", "ODOM: the time stamp is missing or absurd"},
      {"ODOM 1 2 3 0 0 0\n", "ODOM: the time stamp is missing or absurd"},
      {"TRUEPOS 1 2\n", "TRUEPOS: the line ends early"},
      {"PARAM robot_frontlaser_offset wide nohost 0\n", "PARAM: a field is not a number"},
      {"FLASER 0 0 0 0 0 0 0 1.0 host 1.0\n", "FLASER: the count of readings"},
      {"FLASER 1000000 1 2 0 0 0 0 0 0 1.0 host 1.0\n", "FLASER: the count of readings"},
      {"FLASER 99999 1 2 0 0 0 0 0 0 1.0 host 1.0\n", "FLASER: the line ends early"},
      {"FLASER 3 1 2 0 0 0 0 0 0 1.0 host 1.0\n", "FLASER: the time stamp is missing or absurd"},
      {"FLASER 1 1 2 0 0 0 0 0 0 1.0 host 1.0\n", "FLASER: the line goes on after its last field"},
      {"RAWLASER1 0 -1.5 90 45 8 0.01 0 3 1 1 1 0 1.5 host 0\n",
       "RAWLASER1: the stated bearings are no sweep"},
      {"RAWLASER1 0 -1.5 inf 45 8 0.01 0 3 1 1 1 0 1.5 host 0\n",
       "RAWLASER1: a pose or an angle is not finite"},
      {"\x01\x02\x03 \xff\n", "line: the line is not text"},
  };
  for (const auto& [line, what] : faulty_lines) {
    SCOPED_TRACE(line);
    const LogContent log = ReadLogText(std::string("# CARMEN Logfile\n") + line);
    EXPECT_TRUE(log.records.empty());
    ASSERT_EQ(log.report.faults.size(), 1U);
    EXPECT_TRUE(log.report.faults[0].what.starts_with(what)) << log.report.faults[0].what;
    EXPECT_EQ(log.report.faults[0].first_line, 2U);
    EXPECT_EQ(log.report.malformed_lines(), 1U);
    LogOptions strict;
    strict.strict = true;
    EXPECT_TRUE(FailureOf(std::string("# CARMEN Logfile\n") + line, strict)
                    .starts_with(std::string("test.log:2: ") + what));
  }
}

TEST(CarmenLog, ReportsEachKindOfFaultOnce) {
  std::vector<std::string> messages;
  LogOptions options;
  options.on_fault = [&](const std::string& message) { messages.push_back(message); };
  const LogContent log = ReadLogText(
      "ODOM 1 2 3 0 0 0 1.0 host 1.0\nODOM 1 2 x\nODOM 1 2\nODOM 1 y\nODOM 4 2 3 0 0 0 2.0 host "
      "1.0\n",
      options);
  EXPECT_EQ(log.odometry.size(), 2U);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_TRUE(messages[0].starts_with("test.log:2: ODOM: a field is not a number"));
  EXPECT_TRUE(messages[1].starts_with("test.log:3: ODOM: the line ends early"));
  EXPECT_EQ(log.report.faults[0].count, 2U);
}

TEST(CarmenLog, UsesALineWithOddReadingsAllTheSame) {
  const LogContent log = ReadLogText("FLASER 4 nan inf -1 2.5 0 0 0 0 0 0 1.0 host 1.0\n");
  ASSERT_EQ(log.scans.size(), 1U);
  const LaserScan& scan = log.scans[0].scan;
  EXPECT_EQ(StateOf(scan.ranges_m[0], scan.geometry), BeamState::kInvalid);
  EXPECT_EQ(StateOf(scan.ranges_m[1], scan.geometry), BeamState::kMiss);
  EXPECT_EQ(StateOf(scan.ranges_m[2], scan.geometry), BeamState::kTooNear);
  EXPECT_EQ(StateOf(scan.ranges_m[3], scan.geometry), BeamState::kHit);
  ASSERT_EQ(log.report.faults.size(), 1U);
  EXPECT_FALSE(log.report.faults[0].line_was_skipped);
  EXPECT_EQ(log.report.malformed_lines(), 0U);
}

TEST(CarmenLog, DeliversWhatStandsBeforeAStrictFailure) {
  std::istringstream stream(
      "ODOM 1 2 3 0 0 0 1.0 host 1.0\nODOM 1 2\nODOM 1 2 3 0 0 0 2.0 host 1.0\n");
  LogOptions options;
  options.strict = true;
  const auto reader = OpenLog(stream, "test.log", options);
  EXPECT_TRUE(reader->Next().has_value());
  EXPECT_THROW(reader->Next(), LogError);
  EXPECT_FALSE(reader->Next().has_value());
}

}  // namespace
}  // namespace qwsm::io
