// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Bags that say little, too much, or what contradicts itself.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>
#include <sstream>

#include "tests/support/bag_drive.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

/// Fields of a scan of ROS 1, in the order of the message.
enum class ScanField : std::size_t { kAngleMin, kAngleMax, kStep, kTimeStep, kTime, kMin, kMax };

/// Writes a field anew in all scans. @pre their frame is "laser".
void PutInScans(std::vector<MadeMessage>& messages, ScanField field, float value) {
  constexpr std::size_t kHeader = 4 + 8 + 4 + 5;
  for (MadeMessage& message : messages) {
    if (message.topic != "/scan") continue;
    std::memcpy(&message.bytes[kHeader + 4 * static_cast<std::size_t>(field)], &value, 4);
  }
}

std::size_t CountOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_F(Bag, TakesTheAngleBetweenBeamsFromTheFirstAndLastWhereItIsNone) {
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  for (const float step_rad : {0.0F, 1e-9F, kNotANumber}) {
    std::vector<MadeMessage> drive = Drive(Ros::k1);
    PutInScans(drive, ScanField::kStep, step_rad);
    const LogContent log = ReadRos1(drive);
    ASSERT_EQ(log.scans.size(), 4U);
    EXPECT_NEAR(log.scans[0].scan.geometry.bearing_step_rad, 0.1F, 1e-6F);
    EXPECT_EQ(told_, "");
  }
}

TEST_F(Bag, RefusesScansWhoseBeamsLookAllInOneDirection) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  PutInScans(drive, ScanField::kStep, 0.0F);
  PutInScans(drive, ScanField::kAngleMax, -1.0F);
  EXPECT_TRUE(ReadRos1(drive).scans.empty());
  EXPECT_EQ(CountOf(told_, "all in one direction"), 1U) << told_;
}

TEST_F(Bag, TellsOnceThatBearingsContradictEachOther) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  PutInScans(drive, ScanField::kAngleMax, -0.7F);  // One beam more, as some drivers count.
  EXPECT_EQ(ReadRos1(drive).scans.size(), 4U);
  EXPECT_EQ(told_, "");
  PutInScans(drive, ScanField::kAngleMax, 1.0F);
  EXPECT_EQ(ReadRos1(drive).scans.size(), 4U);
  EXPECT_EQ(CountOf(told_, "bearings of /scan contradict each other"), 1U) << told_;
}

TEST_F(Bag, SaysHowToMendRangesThatNoLaserHas) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  PutInScans(drive, ScanField::kMax, 30'000.0F);
  EXPECT_TRUE(ReadRos1(drive).scans.empty());
  EXPECT_NE(told_.find("they are 0.1 and 30000; --set log.range_max_m="), std::string::npos) << told_;
  LogOptions options;
  options.range_max_m = 30.0F;
  EXPECT_EQ(ReadRos1(drive, "none", options).scans.size(), 4U);
}

TEST_F(Bag, TakesScansOfARangeWithoutLimit) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  PutInScans(drive, ScanField::kMax, std::numeric_limits<float>::infinity());
  EXPECT_EQ(ReadRos1(drive).scans.size(), 4U);
  EXPECT_EQ(told_, "");
}

TEST_F(Bag, OfSeveralFilesOfOneRecordingSaysOnceWhereTheLaserSits) {
  const std::vector<MadeMessage> drive = Drive(Ros::k1);
  const std::vector<MadeMessage> first(drive.begin(), drive.begin() + 4);
  const std::vector<MadeMessage> second(drive.begin() + 4, drive.end());  // Has the transform.
  const std::array files{folder_.path() / "0.bag", folder_.path() / "1.bag"};
  test::WriteBytes(files[0], test::Ros1BagOf(first, "none"));
  test::WriteBytes(files[1], test::Ros1BagOf(second, "none"));
  const auto readers = OpenLogs(files);
  ASSERT_EQ(readers.size(), 1U);
  ExpectDrive(test::ReadAll(*readers.front()));
}

TEST_F(Bag, TellsOfScansThatNoOdometryIsNearTo) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  std::erase_if(drive, [](const MadeMessage& message) { return message.topic == "/odom"; });
  drive.push_back(test::OdometryMessageOf(Ros::k1, "/odom", 2000s, "base_link", {}));
  EXPECT_FALSE(ReadRos1(drive).scans.at(0).T_odom_robot);
  EXPECT_NE(told_.find("4 of 4 scans have no odometry within reach: scans are from 1000.0 s to "
                       "1000.3 s, odometry from 2000.0 s to 2000.0 s"),
            std::string::npos)
      << told_;
}

TEST_F(Bag, TellsWhereStampsFallBack) {
  std::vector<MadeMessage> drive = Drive(Ros::k1);
  const std::vector<MadeMessage> again = drive;
  for (int i = 20; i < 24; ++i) {
    drive.push_back(test::ScanMessage(Ros::k1, "/scan", At(i), "laser", RangesAt(i)));
  }
  drive.insert(drive.end(), again.begin(), again.end());
  ReadRos1(drive);
  EXPECT_NE(told_.find("stamps of /scan fall back by 2.3 s at message 15:"), std::string::npos)
      << told_;
}

TEST_F(Bag, TellsThatItsScansNeedNoFieldOfView) {
  LogOptions options;
  options.field_of_view_rad = 3.0;
  ExpectDrive(ReadRos1(Drive(Ros::k1), "none", options));
  EXPECT_NE(told_.find("log.field_of_view_deg is left out"), std::string::npos) << told_;
}

TEST_F(Bag, CannotComeFromAPipe) {
  std::istringstream pipe(test::Ros1BagOf(Drive(Ros::k1), "none"));
  const std::string refusal = FailureOf([&] { OpenLog(pipe, kStandardInput); });
  EXPECT_NE(refusal.find("read from a pipe; name the file of a bag"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace qwsm::io
