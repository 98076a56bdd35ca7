// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "qwsm/sensor/gyro_track.hpp"
#include "service/io/bags/containers/chunk_cache.hpp"
#include "service/io/bags/containers/chunk_codec.hpp"
#include "tests/support/bag_drive.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

TEST_F(Bag, OfRos1IsReadWhateverItsChunks) {
  for (const char* compression : {"none", "bz2", "lz4", "unchunked"}) {
    SCOPED_TRACE(compression);
    const LogContent log = ReadRos1(Drive(Ros::k1), compression);
    ExpectDrive(log);
    EXPECT_EQ(log.report.format, "ROS 1 bag");
  }
}

TEST_F(Bag, OfMcapIsReadWhateverItsChunksAndWithoutAnIndex) {
  for (const char* compression : {"", "zstd", "lz4", "unchunked"}) {
    SCOPED_TRACE(compression);
    const LogContent log = ReadMcap(Drive(Ros::k2), compression);
    EXPECT_EQ(log.report.format, "rosbag2 (mcap)");
    ASSERT_EQ(log.scans.size(), 4U);
    EXPECT_EQ(log.scans[3].T_odom_robot, OdometryAt(3));
    EXPECT_EQ(log.report.faults.size(), 1U) << "that it is cut off";
  }
}

TEST_F(Bag, OfSqliteIsReadInAllSchemasAndWithPackedMessages) {
  for (const int schema : {1, 2, 3, 4}) {
    for (const bool packs : {false, true}) {
      SCOPED_TRACE(schema);
      const std::string name = std::to_string(schema) + (packs ? "p.db3" : ".db3");
      test::WriteDb3(folder_.path() / name, Drive(Ros::k2), schema, packs);
      ExpectDrive(Read(name));
    }
  }
}

TEST_F(Bag, IsReadFromAFolderOfSeveralFilesPackedAsAWhole) {
  const std::vector<MadeMessage> drive = Drive(Ros::k2);
  const std::span<const MadeMessage> all(drive);
  for (int i = 0; i < 3; ++i) {
    const auto part = folder_.path() / ("drive_" + std::to_string(i) + ".db3");
    test::WriteDb3(part, all.subspan(static_cast<std::size_t>(3 * i), 3), 3);
    test::WriteBytes(part.string() + ".zstd", CompressZstd(test::ReadBytes(part)));
    std::filesystem::remove(part);
  }
  test::WriteBytes(folder_.path() / "metadata.yaml",
                   "rosbag2_bagfile_information:\n  version: 4\n  relative_file_paths:\n"
                   "    - drive_0.db3.zstd\n    - drive_1.db3.zstd\n    - drive_2.db3.zstd\n"
                   "  message_count: 9\n");
  ExpectDrive(Read(""));
  std::filesystem::remove(folder_.path() / "metadata.yaml");
  ExpectDrive(Read(""));
}

TEST_F(Bag, TellsWhichFileOfAFolderIsMissing) {
  test::WriteDb3(folder_.path() / "drive_0.db3", Drive(Ros::k2), 3);
  test::WriteBytes(folder_.path() / "metadata.yaml",
                   "rosbag2_bagfile_information:\n  relative_file_paths:\n"
                   "    - drive_0.db3\n    - drive_1.db3\n");
  ExpectDrive(Read(""));
  EXPECT_NE(told_.find("names drive_1.db3, which is missing"), std::string::npos) << told_;
}

TEST_F(Bag, GivesScansInTheOrderOfTheirStampsWhateverTheOrderOnDisk) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  std::reverse(drive.begin(), drive.end());
  ExpectDrive(ReadRos1(drive));
}

TEST_F(Bag, TakesOdometryFromTfAlone) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    const Timestamp middle = At(i) - 50ms;
    drive.push_back(test::TransformMessageOf(
        Ros::k1, "/tf", middle, "/odom", "/base", Spatial({0.1 * i - 0.05, 0, 0})));
    drive.push_back(
        test::TransformMessageOf(Ros::k1, "/tf", middle, "/base", "/laser", Spatial({0.3, 0, 0})));
    drive.push_back(test::ScanMessage(Ros::k1, "/scan", At(i), "laser", RangesAt(i)));
  }
  const LogContent log = ReadRos1(drive);
  ASSERT_EQ(log.scans.size(), 4U);
  EXPECT_NEAR(log.scans[1].T_odom_robot->x_m, 0.1, 1e-12);
  EXPECT_EQ(log.scans[1].scan.geometry.T_robot_laser, (Pose2{0.3, 0, 0}));
}

TEST_F(Bag, FindsTheMountingOverSeveralFrames) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive.pop_back();
  drive.push_back(test::TransformMessageOf(
      Ros::k2, "/tf_static", 0s, "base_footprint", "base_link", Spatial({0.0, 0.0, 0.0})));
  drive.push_back(test::TransformMessageOf(
      Ros::k2, "/tf_static", 0s, "base_link", "mast", Spatial({0.5, 0, std::numbers::pi / 2})));
  drive.push_back(
      test::TransformMessageOf(Ros::k2, "/tf_static", 0s, "mast", "laser", Spatial({0.1, 0, 0})));
  const Pose2 mounting = ReadMcap(drive).scans.at(0).scan.geometry.T_robot_laser;
  EXPECT_NEAR(mounting.x_m, 0.5, 1e-12);
  EXPECT_NEAR(mounting.y_m, 0.1, 1e-12);
  EXPECT_NEAR(mounting.theta_rad, std::numbers::pi / 2, 1e-12);
}

TEST_F(Bag, TurnsTheScansOfAnUpsideDownLaser) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive.pop_back();
  // Rolled by 180 degrees, looking to the left.
  const Quaternion rolled = QuaternionOf(std::numbers::pi / 2) * Quaternion{1.0, 0.0, 0.0, 0.0};
  drive.push_back(test::TransformMessageOf(
      Ros::k2, "/tf_static", 0s, "base_link", "laser", {.rotation = rolled}));
  const LaserGeometry geometry = ReadMcap(drive).scans.at(0).scan.geometry;
  EXPECT_NEAR(geometry.T_robot_laser.theta_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(geometry.first_bearing_rad, 1.0F);
  EXPECT_EQ(geometry.bearing_step_rad, -0.1F);
}

TEST_F(Bag, TellsHowFarTheGyroTurned) {
  for (const Ros ros : {Ros::k1, Ros::k2}) {
    std::vector<MadeMessage> drive = Drive(ros);
    for (auto stamp = At(0) - 10ms; stamp < At(2) + 5ms; stamp += 20ms) {
      drive.push_back(test::ImuMessageOf(ros, "/imu", stamp, "imu", -0.5));
    }
    drive.push_back(test::TransformMessageOf(  // Upside down.
        ros,
        "/tf_static",
        0s,
        "base_link",
        "imu",
        {.rotation = {.x = 1.0, .w = 0.0}}));
    GyroTrack gyro;
    std::vector<std::optional<double>> at_scans;
    for (const LogRecord& record : (ros == Ros::k1 ? ReadRos1(drive) : ReadMcap(drive)).records) {
      if (const auto* imu = std::get_if<ImuReading>(&record)) gyro.Add(*imu);
      if (const auto* reading = std::get_if<ScanReading>(&record)) {
        at_scans.push_back(gyro.At(reading->scan.stamp));
      }
    }
    ASSERT_TRUE(at_scans.at(0) && at_scans.at(1)) << "readings up to a scan come before it";
    const std::chrono::duration<double> since = At(1) - At(0);
    EXPECT_NEAR(*at_scans[1] - *at_scans[0], 0.5 * since.count(), 1e-9);
    EXPECT_FALSE(at_scans.at(3)) << "it was silent by then";
  }
}

/// A front and a rear laser on topics that may be one.
std::vector<MadeMessage> DriveOfTwoLasers(const std::string& front, const std::string& rear) {
  std::vector<MadeMessage> drive;
  const io::Transform3 looking_back = Spatial({-0.2, 0.0, 3.0});
  for (int i = 0; i < 4; ++i) {
    drive.push_back(test::OdometryMessageOf(Ros::k2, "/odom", At(i), "base_link", OdometryAt(i)));
    drive.push_back(test::ScanMessage(Ros::k2, front, At(i), "ahead", RangesAt(i)));
    drive.push_back(test::ScanMessage(Ros::k2, rear, At(i) + 50ms, "behind", RangesAt(i + 1)));
  }
  for (const auto& [frame, mounting] :
       {std::pair("ahead", Spatial(kMounting)), std::pair("behind", looking_back)}) {
    drive.push_back(
        test::TransformMessageOf(Ros::k2, "/tf_static", 0s, "base_link", frame, mounting));
  }
  return drive;
}

TEST_F(Bag, TellsLasersOnOneTopicApartByTheirFrames) {
  const LogContent two = ReadMcap(DriveOfTwoLasers("/front/scan", "/rear/scan"));
  const LogContent one = ReadMcap(DriveOfTwoLasers("/scan", "/scan"));
  ASSERT_EQ(two.scans.size(), 8U);
  ASSERT_EQ(one.scans.size(), two.scans.size());
  for (std::size_t i = 0; i < two.scans.size(); ++i) {
    EXPECT_EQ(one.scans[i].laser, two.scans[i].laser);
    EXPECT_EQ(one.scans[i].scan.stamp, two.scans[i].scan.stamp);
    EXPECT_EQ(one.scans[i].scan.geometry, two.scans[i].scan.geometry);
    EXPECT_EQ(one.scans[i].scan.ranges_m, two.scans[i].scan.ranges_m);
    EXPECT_EQ(one.scans[i].T_odom_robot, two.scans[i].T_odom_robot);
  }
  LogOptions chosen;
  chosen.scan_topics = {"scan"};
  EXPECT_EQ(Read("t.mcap", chosen).scans.size(), 8U);
  chosen.scan_topics = {"/scan[behind]"};
  EXPECT_EQ(Read("t.mcap", chosen).scans.size(), 4U);
}

// Level for twenty seconds, then the nose sinks to 0.1 rad: 0.2 m up, the floor is 2 m ahead.
TEST_F(Bag, LeavesOutBeamsThatHitTheFloor) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  for (auto stamp = At(0) - 30s; stamp < At(4); stamp += 10ms) {
    const std::chrono::duration<double> sinking = stamp - (At(0) - 10s);
    const double pitch_rad = std::clamp(0.01 * sinking.count(), 0.0, 0.1);
    drive.push_back(
        test::ImuMessageOf(Ros::k2,
                           "/imu",
                           stamp,
                           "base_link",
                           0.0,
                           {-9.81 * std::sin(pitch_rad), 0.0, 9.81 * std::cos(pitch_rad)}));
  }
  LogOptions options;
  const LogContent level = ReadMcap(drive, "zstd", options);
  EXPECT_EQ(level.scans.at(0).scan.ranges_m[2], RangesAt(0)[2]) << "how high it sits nobody says";
  options.laser_height_m = 0.2;
  const LogContent high = Read("t.mcap", options);
  EXPECT_EQ(high.scans.at(0).scan.ranges_m[0], RangesAt(0)[0]) << "1 m ahead";
  EXPECT_TRUE(std::isnan(high.scans.at(0).scan.ranges_m[2])) << "3 m ahead";
  EXPECT_NE(high.report.notes.back().find("may have hit the floor"), std::string::npos);
}

TEST_F(Bag, LeavesOutLasersThatDoNotFit) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive.push_back(test::ScanMessage(Ros::k2, "/mast/scan", At(1), "mast", RangesAt(1)));
  drive.push_back(test::ScanMessage(Ros::k2, "/tilted/scan", At(1), "tilted", RangesAt(2)));
  drive.push_back(test::TransformMessageOf(Ros::k2,
                                           "/tf_static",
                                           0s,
                                           "base_link",
                                           "tilted",
                                           {.rotation = {.y = std::sin(0.3), .w = std::cos(0.3)}}));
  EXPECT_EQ(ReadMcap(drive).scans.size(), 4U);
  EXPECT_NE(told_.find("/mast/scan is left out"), std::string::npos) << told_;
  EXPECT_NE(told_.find("/tilted/scan is left out"), std::string::npos) << told_;
}

TEST_F(Bag, DeskewsScansWhoseBeamsHaveTimes) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    drive.push_back(test::OdometryMessageOf(Ros::k2, "/odom", At(i), "laser", {0, 0, 0.02 * i}));
    drive.push_back(test::ScanMessage(Ros::k2, "/scan", At(i), "laser", RangesAt(i), 0.025F));
  }
  // Half of the time to the next scan, and of the turn, over two steps.
  EXPECT_NEAR(ReadMcap(drive).scans.at(0).scan.geometry.bearing_step_rad, 0.1 + 0.005, 1e-6);
  LogOptions options;
  options.mirrored = true;
  const LaserGeometry mirrored = ReadMcap(drive, "zstd", options).scans.at(0).scan.geometry;
  EXPECT_EQ(mirrored.first_bearing_rad, 1.0F);
  EXPECT_NEAR(mirrored.bearing_step_rad, -0.1 + 0.005, 1e-6);
  options.sweep_s = 0.0;
  EXPECT_EQ(ReadMcap(drive, "zstd", options).scans.at(0).scan.geometry.bearing_step_rad, -0.1F);
}

TEST_F(Bag, GivesScansAsMeasuredToWhoAsksForThat) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    drive.push_back(test::OdometryMessageOf(Ros::k2, "/odom", At(i), "laser", {0, 0, 0.2 * i}));
    drive.push_back(test::ScanMessage(Ros::k2, "/scan", At(i), "laser", RangesAt(i), 0.025F));
  }
  LogOptions options;
  options.as_measured = true;
  const ScanReading reading = ReadMcap(drive, "zstd", options).scans.at(0);
  EXPECT_EQ(reading.scan.geometry.bearing_step_rad, 0.1F);
  EXPECT_EQ(reading.scan.sweep,
            50'000'001ns);  // A message tells the time between beams as a float.
  ASSERT_TRUE(reading.T_odom_end);
  EXPECT_NEAR(reading.T_odom_end->theta_rad, 0.1, 1e-6);
}

TEST_F(Bag, LeavesTheTimesOfBeamsWithAScanThatHasNoOdometry) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 4; ++i) {
    drive.push_back(test::ScanMessage(Ros::k2, "/scan", At(i), "laser", RangesAt(i), 0.025F));
  }
  const ScanReading reading = ReadMcap(drive).scans.at(0);
  EXPECT_EQ(reading.scan.geometry.bearing_step_rad, 0.1F);
  EXPECT_EQ(reading.scan.sweep,
            50'000'001ns);  // A message tells the time between beams as a float.
}

TEST_F(Bag, SaysThatNothingTellsWhereTheLaserSits) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  drive.pop_back();
  EXPECT_EQ(ReadMcap(drive).scans.at(0).scan.geometry.T_robot_laser, Pose2{});
  EXPECT_NE(told_.find("nothing says where the laser 'laser' of /scan sits on 'base_link'"),
            std::string::npos)
      << told_;
}

TEST_F(Bag, TellsWhichMessagesAreNotNeeded) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  for (int i = 0; i < 3; ++i) {
    drive.push_back({"/clock", "rosgraph_msgs/msg/Clock", std::string("\0\1\0\0", 4) + "12345678"});
  }
  const LogContent log = ReadMcap(drive);
  EXPECT_EQ(log.scans.size(), 4U);
  EXPECT_EQ(log.report.other_messages, 3U);
  EXPECT_EQ(log.report.notes.back(),
            "messages that are not needed: 3 of rosgraph_msgs/Clock (time is that of the stamps in "
            "headers)");
}

TEST_F(Bag, PassesOverMessagesThatAreNotWhatTheyShouldBeAndTellsOnce) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  MadeMessage torn = drive[1];
  torn.bytes.resize(20);
  MadeMessage vast = drive[1];
  vast.bytes[4 + 8 + 4 + 8 + 28] = '\x7F';  // The count of its ranges.
  vast.bytes[4 + 8 + 4 + 8 + 28 + 3] = '\x7F';
  drive.push_back(torn);
  drive.push_back(torn);
  drive.push_back(vast);
  const LogContent log = ReadMcap(drive);
  EXPECT_EQ(log.scans.size(), 4U);
  EXPECT_NE(told_.find("message 10 (/scan): a length in it is beyond its end"), std::string::npos)
      << told_;
  EXPECT_GE(log.report.malformed_lines(), 3U);
  LogOptions options;
  options.strict = true;
  EXPECT_NE(FailureOf([&] { ReadMcap(drive, "zstd", options); }), "");
}

TEST_F(Bag, GoesAroundADamagedChunk) {
  for (const char* compression : {"zstd", "lz4", ""}) {
    SCOPED_TRACE(compression);
    std::string bytes = test::McapOf(Drive(Ros::k2), compression, 1);
    const std::size_t chunk = bytes.find('\x06', 40);
    bytes[chunk + 1 + 5] = '\x7F';  // Its length is absurd now.
    test::WriteBytes(folder_.path() / "t.mcap", bytes);
    EXPECT_GE(Read("t.mcap").scans.size(), 4U);
    EXPECT_NE(told_.find("or the chunk is damaged"), std::string::npos) << told_;
  }
  std::string bytes = test::Ros1BagOf(Drive(Ros::k1), "lz4", 1);
  const std::size_t second = bytes.find("op=\x05", bytes.find("op=\x05") + 1);
  bytes[bytes.find("size=", second) + 12] = '\x7F';
  test::WriteBytes(folder_.path() / "t.bag", bytes);
  EXPECT_GE(Read("t.bag").scans.size(), 3U);
}

// SQLite's file format, section 1.6: of a page of type 5 each cell begins with the page of its
// rows. @return the bytes with the second cell of the first such page leading where the first does.
std::string WithPagesInACircle(std::string bytes) {
  constexpr std::size_t kPage = 4096;
  constexpr std::size_t kHeader = 12;
  for (std::size_t page = kPage; page + kPage <= bytes.size(); page += kPage) {
    if (bytes[page] != '\x05') continue;
    const auto cell = [&](std::size_t i) {
      const auto at = [&](std::size_t k) { return static_cast<unsigned char>(bytes[page + k]); };
      return page + (std::size_t{at(kHeader + 2 * i)} << 8U) + at(kHeader + 2 * i + 1);
    };
    return bytes.replace(cell(1), 4, bytes.substr(cell(0), 4));
  }
  return bytes;
}

TEST_F(Bag, TellsADatabaseWhosePagesGoInACircle) {
  std::vector<MadeMessage> drive;
  for (int i = 0; i < 100; ++i) {
    for (const MadeMessage& message : Drive(Ros::k2)) drive.push_back(message);
  }
  test::WriteDb3(folder_.path() / "t.db3", drive, 3);
  const std::size_t all = Read("t.db3").scans.size();
  test::WriteBytes(folder_.path() / "t.db3",
                   WithPagesInACircle(test::ReadBytes(folder_.path() / "t.db3")));
  EXPECT_LE(Read("t.db3").scans.size(), all);
  EXPECT_NE(told_.find("its pages go round in a circle"), std::string::npos) << told_;
}

TEST_F(Bag, OfSqliteThatIsCutOffIsReadUpToThere) {
  std::vector<MadeMessage> drive = Drive(Ros::k2);
  const std::vector<float> ranges(100, 2.0F);
  for (int i = 4; i < 200; ++i) {
    drive.push_back(test::ScanMessage(Ros::k2, "/scan", At(i), "laser", ranges));
  }
  const std::filesystem::path file = folder_.path() / "t.db3";
  test::WriteDb3(file, drive, 4);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 10 * 7);
  EXPECT_GT(Read("t.db3").scans.size(), 80U);
  EXPECT_NE(told_.find("the database is damaged"), std::string::npos) << told_;
}

TEST(ChunkCache, KeepsFewerOfLargeChunks) {
  for (const std::size_t size : {std::size_t{1} << 10, std::size_t{40} << 20}) {
    int loads = 0;
    ChunkCache cache([&](std::uint64_t offset) {
      ++loads;
      return std::string(size, static_cast<char>(offset));
    });
    for (const std::uint64_t offset : {1, 2, 1, 2}) {
      EXPECT_EQ(cache.At(offset).front(), static_cast<char>(offset));
    }
    EXPECT_EQ(loads, size < 2000 ? 2 : 4);
  }
}

TEST_F(Bag, OfAnOlderFormatIsToldHowToMendIt) {
  test::WriteBytes(folder_.path() / "old.bag", "#ROSBAG V1.2\n and more");
  EXPECT_NE(FailureOf([&] { Read("old.bag"); }).find("rosbag fix"), std::string::npos);
}

}  // namespace
}  // namespace qwsm::io
