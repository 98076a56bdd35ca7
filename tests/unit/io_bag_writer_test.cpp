// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <variant>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/bags/containers/bag_files.hpp"
#include "service/io/bags/writing/log_bag_writer.hpp"
#include "service/io/bags/writing/message_definitions.hpp"
#include "tests/support/bag_maker.hpp"
#include "tests/support/log_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

/// Scans whose numbers have all their digits, two of them with one stamp.
std::vector<LogRecord> Records() {
  std::vector<LogRecord> records;
  for (int i = 0; i < 6; ++i) {
    const double third = i / 3.0;
    const Timestamp stamp = 976052857s + std::max(i, 1) * 123456789ns;
    LaserScan scan{.stamp = stamp,
                   .geometry = {.first_bearing_rad = -1.5707964F,
                                .bearing_step_rad = 0.017453292F,
                                .range_min_m = 0.0F,
                                .range_max_m = 81.9F,
                                .T_robot_laser = {0.1234567890123, -1.0 / 3.0, -2.5}},
                   .ranges_m = {static_cast<float>(1.0 + third), 81.91F, 0.3F}};
    records.push_back(ScanReading{.scan = std::move(scan),
                                  .T_odom_robot = Pose2{third, -third, -3.0 + third},
                                  .laser = "front"});
  }
  return records;
}

ImuReading FeltWith(bool all) {
  ImuReading reading{.stamp = 5s + 123456789ns, .turn_rate_rad_s = {0.1, -1.0 / 3.0, 2.0 / 7.0}};
  if (all) reading.acceleration_mps2 = Eigen::Vector3d(0.1, -0.2, 9.81 / 3.0);
  if (all) reading.orientation = Quaternion{0.1, 0.2, 0.3, 0.9};
  return reading;
}

class BagWriting : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path Write(const std::vector<LogRecord>& records) {
    const std::filesystem::path path = folder_.path() / GetParam();
    BagFile bag(path, BagFormatOf(path).value_or(BagFormat::kMcap));
    LogBagWriter writer(bag);
    for (const LogRecord& record : records) writer.Write(record);
    bag.Commit();
    return path;
  }

  test::TemporaryFolder folder_;
};

TEST_P(BagWriting, GivesTheSameScansBackToTheLastBit) {
  const std::vector<LogRecord> records = Records();
  const test::LogContent log = test::ReadAll(*OpenLog(Write(records)));
  ASSERT_EQ(log.scans.size(), records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto& written = std::get<ScanReading>(records[i]);
    EXPECT_EQ(log.scans[i].scan.stamp, written.scan.stamp);
    EXPECT_EQ(log.scans[i].scan.geometry, written.scan.geometry);
    EXPECT_EQ(log.scans[i].scan.ranges_m, written.scan.ranges_m);
    EXPECT_EQ(log.scans[i].T_odom_robot, written.T_odom_robot);
  }
  EXPECT_TRUE(log.report.faults.empty());
}

TEST_P(BagWriting, KeepsTheTruthOfASimulator) {
  const TruePoseReading truth{.stamp = 5s, .T_world_robot = {1, 2, 3}, .T_odom_robot = Pose2{}};
  const test::LogContent log = test::ReadAll(*OpenLog(Write({Records()[0], LogRecord(truth)})));
  ASSERT_EQ(log.true_poses.size(), 1U);
  EXPECT_EQ(log.true_poses[0].T_world_robot, truth.T_world_robot);
}

TEST_P(BagWriting, KeepsWhatAnInertialSensorFelt) {
  for (const bool all : {true, false}) {
    const ImuReading felt = FeltWith(all);
    const test::LogContent log = test::ReadAll(*OpenLog(Write({LogRecord(felt), Records()[0]})));
    ASSERT_EQ(log.imu.size(), 1U);
    EXPECT_EQ(log.report.imu_readings, 1U);
    EXPECT_EQ(log.imu[0].stamp, felt.stamp);
    EXPECT_EQ(log.imu[0].turn_rate_rad_s, felt.turn_rate_rad_s);
    EXPECT_EQ(log.imu[0].acceleration_mps2, felt.acceleration_mps2);
    ASSERT_EQ(log.imu[0].orientation.has_value(), all);
    EXPECT_EQ(log.imu[0].orientation.value_or(Quaternion{}).w, all ? 0.9 : 1.0);
  }
}

TEST_P(BagWriting, TakesMessagesOfTypesWithoutAHash) {
  const std::filesystem::path path = folder_.path() / GetParam();
  BagFile bag(path, BagFormatOf(path).value_or(BagFormat::kMcap));
  const TopicToWrite topic{.name = "/qwsm/marks", .type = "qwsm_msgs/msg/Mark"};
  ASSERT_TRUE(TypeHash(topic.type).empty());
  bag.Write(topic, 1s, std::string(40, '\0'));
  bag.Write(topic, 2s, {});
  bag.Commit();
  OpenBagFile written(BagFormatOf(path) ? path : path / "folder_0.mcap",
                      [](std::uint64_t, const std::string& what) { ADD_FAILURE() << what; });
  std::size_t messages = 0;
  while (written.messages().Next()) ++messages;
  EXPECT_EQ(messages, 2U);
}

TEST_P(BagWriting, RefusesATimeThatRos2DoesNotHave) {
  EXPECT_THROW(Write({OdometryReading{.stamp = 3'000'000'000s, .T_odom_robot = {}}}), WriteError);
}

TEST_P(BagWriting, ThatCannotGoOnLeavesWhatWasWritten) {
  constexpr int kWritten = 4000;
  const std::filesystem::path path = folder_.path() / GetParam();
  std::filesystem::path unfinished;
  {
    BagFile bag(path, BagFormatOf(path).value_or(BagFormat::kMcap));
    unfinished = bag.KeepUnfinished();
    LogBagWriter writer(bag);
    auto reading = std::get<ScanReading>(Records()[0]);
    reading.T_odom_robot.reset();
    for (int i = 0; i < kWritten; ++i) {
      reading.scan.stamp = 1s * i;
      reading.scan.ranges_m.assign(500, 1.0F + 0.001F * static_cast<float>(i));
      writer.Write(reading);
    }
  }
  const test::LogContent log = test::ReadAll(*OpenLog(unfinished));
  EXPECT_GT(log.scans.size(), kWritten / 2U);
  EXPECT_EQ(log.scans.back().scan.stamp, 1s * (log.scans.size() - 1)) << "none is missing between";
}

INSTANTIATE_TEST_SUITE_P(All,
                         BagWriting,
                         testing::Values("drive.mcap", "drive.db3", "folder"),
                         [](const auto& tested) { return "Bag" + std::to_string(tested.index); });

TEST(McapWriting, TellsInItsSummaryWhatADamagedFirstChunkDeclared) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "t.mcap";
  constexpr int kScans = 1000;
  BagFile bag(path, BagFormat::kMcap);
  LogBagWriter writer(bag);
  std::mt19937 random(3);
  for (int i = 0; i < kScans; ++i) {
    LaserScan scan{.stamp = 1s * i, .geometry = {}, .ranges_m = std::vector<float>(500)};
    scan.geometry.bearing_step_rad = 0.01F;
    scan.geometry.range_max_m = 30.0F;
    for (float& range_m : scan.ranges_m) range_m = static_cast<float>(random() % 20'000) / 1e3F;
    writer.Write(ScanReading{.scan = std::move(scan), .T_odom_robot = Pose2{}, .laser = "front"});
  }
  bag.Commit();
  std::string bytes = test::ReadBytes(path);
  bytes.replace(100, 100, 100, '\xFF');
  test::WriteBytes(path, bytes);
  const test::LogContent log = test::ReadAll(*OpenLog(path));
  EXPECT_GT(log.scans.size(), kScans / 2U);
  EXPECT_LT(log.scans.size(), static_cast<std::size_t>(kScans));
  EXPECT_FALSE(log.report.faults.empty());
}

TEST(MessageDefinitions, BringTheTypesWithinATypeOnceEach) {
  const std::string text = MessageDefinition("nav_msgs/msg/Odometry");
  EXPECT_TRUE(text.starts_with("std_msgs/Header header\nstring child_frame_id\n"));
  const std::size_t quaternion = text.find("MSG: geometry_msgs/Quaternion\n");
  EXPECT_NE(quaternion, std::string::npos);
  EXPECT_EQ(text.find("MSG: geometry_msgs/Quaternion\n", quaternion + 1), std::string::npos);
}

}  // namespace
}  // namespace qwsm::io
