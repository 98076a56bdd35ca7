// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "service/io/logs/carmen_writer.hpp"
#include "service/io/logs/sweep_geometry.hpp"
#include "tests/support/log_text.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

std::string Written(const std::vector<LogRecord>& records,
                    CarmenDialect dialect = CarmenDialect::kRobotLaser) {
  std::ostringstream stream;
  CarmenWriter writer(stream, dialect);
  for (const LogRecord& record : records) writer.Write(record);
  return stream.str();
}

/// Numbers with all the digits a double has.
class RandomRecords {
 public:
  explicit RandomRecords(std::uint32_t seed) : random_(seed) {}

  Pose2 Pose() { return {Between(-100, 100), Between(-100, 100), Between(-3.14, 3.14)}; }
  Timestamp Stamp() {
    return Timestamp(std::uniform_int_distribution<std::int64_t>(1, 1LL << 60)(random_));
  }

  ScanReading Scan(const LaserGeometry& geometry, std::size_t readings) {
    ScanReading reading;
    reading.laser = "front";
    reading.T_odom_robot = Pose();
    reading.scan.stamp = Stamp();
    reading.scan.geometry = geometry;
    for (std::size_t i = 0; i < readings; ++i) {
      reading.scan.ranges_m.push_back(static_cast<float>(Between(0.1, 29.0)));
    }
    return reading;
  }

 private:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
};

LaserGeometry SomeGeometry() {
  return {.first_bearing_rad = -2.1F,
          .bearing_step_rad = 0.0123456F,
          .range_min_m = kNearestReading_m,
          .range_max_m = 29.7F,
          .T_robot_laser = {0.1 / 3.0, -0.2 / 3.0, 0.3 / 7.0}};
}

void ExpectSame(const ScanReading& a, const ScanReading& b) {
  EXPECT_EQ(a.scan.stamp, b.scan.stamp);
  EXPECT_EQ(a.scan.geometry, b.scan.geometry);
  EXPECT_EQ(a.scan.ranges_m, b.scan.ranges_m);
  EXPECT_EQ(a.T_odom_robot, b.T_odom_robot);
  EXPECT_EQ(a.laser, b.laser);
}

TEST(CarmenWriter, WritesWhatReadsBackTheSame) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomRecords random(seed);
    const ScanReading scan = random.Scan(SomeGeometry(), 1 + 20 * seed);
    const OdometryReading odometry{random.Stamp(), random.Pose()};
    const TruePoseReading true_pose{random.Stamp(), random.Pose(), random.Pose()};
    const test::LogContent log = test::ReadLogText(Written({odometry, scan, true_pose}));
    EXPECT_TRUE(log.report.faults.empty());
    ASSERT_EQ(log.records.size(), 3U);
    EXPECT_EQ(log.odometry.at(0).stamp, odometry.stamp);
    EXPECT_EQ(log.odometry.at(0).T_odom_robot, odometry.T_odom_robot);
    ExpectSame(log.scans.at(0), scan);
    EXPECT_EQ(log.true_poses.at(0).stamp, true_pose.stamp);
    EXPECT_EQ(log.true_poses.at(0).T_world_robot, true_pose.T_world_robot);
    EXPECT_EQ(log.true_poses.at(0).T_odom_robot, true_pose.T_odom_robot);
  }
}

TEST(CarmenWriter, WritesWhatAnInertialSensorFelt) {
  ImuReading felt{.stamp = 5s, .turn_rate_rad_s = {0.1, -1.0 / 3.0, 2.0 / 7.0}};
  for (const bool all : {false, true}) {
    if (all) felt.acceleration_mps2 = Eigen::Vector3d(0.1, -0.2, 9.81 / 3.0);
    if (all) felt.orientation = Quaternion{0.1, 0.2, 0.3, 0.9};
    const test::LogContent log = test::ReadLogText(Written({felt}));
    EXPECT_TRUE(log.report.faults.empty());
    ASSERT_EQ(log.imu.size(), 1U);
    EXPECT_EQ(log.imu[0].stamp, felt.stamp);
    EXPECT_EQ(log.imu[0].turn_rate_rad_s, felt.turn_rate_rad_s);
    EXPECT_EQ(log.imu[0].acceleration_mps2, felt.acceleration_mps2);
    ASSERT_EQ(log.imu[0].orientation.has_value(), all);
    EXPECT_EQ(log.imu[0].orientation.value_or(Quaternion{}).z, all ? 0.3 : 0.0);
  }
}

TEST(CarmenWriter, WritesFlaserFromTheRightAsItIsGuessed) {
  RandomRecords random(4);
  const LaserGeometry geometry = GuessGeometry(181, std::nullopt);
  const ScanReading from_the_right = random.Scan(geometry, 181);
  EXPECT_TRUE(IsGuessedRightly(from_the_right.scan));
  ScanReading from_the_left = from_the_right;
  std::ranges::reverse(from_the_left.scan.ranges_m);
  Mirror(from_the_left.scan.geometry);
  EXPECT_TRUE(IsGuessedRightly(from_the_left.scan));
  EXPECT_EQ(Written({from_the_left}, CarmenDialect::kFlaser),
            Written({from_the_right}, CarmenDialect::kFlaser));
  EXPECT_FALSE(IsGuessedRightly(random.Scan(GuessGeometry(181, 4.0), 181).scan));
}

TEST(CarmenWriter, WritesScansWithoutOdometryAsRawOnes) {
  RandomRecords random(1);
  ScanReading scan = random.Scan(SomeGeometry(), 10);
  scan.T_odom_robot.reset();
  const std::string text = Written({scan});
  EXPECT_NE(text.find("RAWLASER1"), std::string::npos);
  ExpectSame(test::ReadLogText(text).scans.at(0), scan);
}

TEST(CarmenWriter, KnowsTheOldDialect) {
  RandomRecords random(1);
  ScanReading scan = random.Scan(GuessGeometry(181, std::nullopt), 181);
  scan.scan.geometry.range_max_m = 81.91F;
  scan.scan.geometry.T_robot_laser = {0.25, 0.0, 0.0};
  const std::string text = Written({scan}, CarmenDialect::kFlaser);
  EXPECT_NE(text.find("\nFLASER 181 "), std::string::npos);
  ExpectSame(test::ReadLogText(text).scans.at(0), scan);
}

TEST(CarmenWriter, WritesTheRearLaserUnderItsOwnName) {
  RandomRecords random(1);
  ScanReading scan = random.Scan(SomeGeometry(), 10);
  scan.laser = "rear";
  LogOptions options;
  options.laser = "rear";
  ExpectSame(test::ReadLogText(Written({scan}), options).scans.at(0), scan);
}

TEST(CarmenWriter, WritesAMountingThatChanges) {
  RandomRecords random(1);
  const ScanReading first = random.Scan(SomeGeometry(), 10);
  LaserGeometry moved = SomeGeometry();
  moved.T_robot_laser.x_m = 0.5;
  const ScanReading second = random.Scan(moved, 10);
  const test::LogContent log = test::ReadLogText(Written({first, second}));
  ExpectSame(log.scans.at(0), first);
  ExpectSame(log.scans.at(1), second);
}

}  // namespace
}  // namespace qwsm::io
