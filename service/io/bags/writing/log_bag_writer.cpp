// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/writing/log_bag_writer.hpp"

#include <cctype>

#include "service/io/bags/writing/ros_encoding.hpp"

namespace qwsm::io {
namespace {

constexpr const char* kOdomFrame = "odom";
constexpr const char* kRobotFrame = "base_link";

const TopicToWrite kOdometry{"/odom", "nav_msgs/msg/Odometry"};
const TopicToWrite kTransforms{"/tf", "tf2_msgs/msg/TFMessage"};
const TopicToWrite kMountings{"/tf_static", "tf2_msgs/msg/TFMessage", true};
const TopicToWrite kImu{"/imu", "sensor_msgs/msg/Imu"};
const TopicToWrite kTruth{"/ground_truth", "nav_msgs/msg/Odometry"};

/// The name of a laser as a part of a topic's: letters, digits and underscores.
std::string NameFor(const std::string& laser) {
  std::string name = laser;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name.empty() || name == "front" ? "" : name;
}

}  // namespace

void LogBagWriter::Write(const LogRecord& record) {
  if (const auto* scan = std::get_if<ScanReading>(&record)) WriteScan(*scan);
  if (const auto* odometry = std::get_if<OdometryReading>(&record)) {
    WriteOdometry(odometry->stamp, odometry->T_odom_robot);
  }
  if (const auto* truth = std::get_if<TruePoseReading>(&record)) WriteTruth(*truth);
  if (const auto* imu = std::get_if<ImuReading>(&record)) WriteImu(*imu);
}

void LogBagWriter::WriteScan(const ScanReading& reading) {
  const LaserScan& scan = reading.scan;
  CheckRosTime(scan.stamp);
  const std::string name = NameFor(reading.laser);
  const std::string frame = name.empty() ? "laser" : name;
  WriteMounting(scan.stamp, frame, scan.geometry.T_robot_laser);
  if (reading.T_odom_robot) WriteOdometry(scan.stamp, *reading.T_odom_robot);
  if (reading.T_odom_end) WriteOdometry(scan.stamp + scan.sweep, *reading.T_odom_end);
  bag_->Write({(name.empty() ? "" : "/" + name) + "/scan", "sensor_msgs/msg/LaserScan"},
              scan.stamp,
              EncodeLaserScan(scan, frame));
}

void LogBagWriter::WriteOdometry(Timestamp stamp, const Pose2& T_odom_robot) {
  CheckRosTime(stamp);
  bag_->Write(kOdometry, stamp, EncodeOdometry(stamp, kOdomFrame, kRobotFrame, T_odom_robot));
  bag_->Write(kTransforms, stamp, EncodeTransform(stamp, kOdomFrame, kRobotFrame, T_odom_robot));
}

void LogBagWriter::WriteTruth(const TruePoseReading& reading) {
  CheckRosTime(reading.stamp);
  bag_->Write(kTruth,
              reading.stamp,
              EncodeOdometry(reading.stamp, "world", kRobotFrame, reading.T_world_robot));
}

void LogBagWriter::WriteImu(const ImuReading& reading) {
  CheckRosTime(reading.stamp);
  bag_->Write(kImu, reading.stamp, EncodeImu(reading, kRobotFrame));
}

void LogBagWriter::WriteMounting(Timestamp stamp,
                                 const std::string& frame,
                                 const Pose2& T_robot_laser) {
  const auto [written, is_new] = T_robot_laser_.try_emplace(frame, T_robot_laser);
  if (!is_new && written->second == T_robot_laser) return;
  written->second = T_robot_laser;
  bag_->Write(kMountings, stamp, EncodeTransform(stamp, kRobotFrame, frame, T_robot_laser));
}

}  // namespace qwsm::io
