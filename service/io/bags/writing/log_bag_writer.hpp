// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "qwsm/logs/log_record.hpp"
#include "service/io/bags/writing/bag_file.hpp"

namespace qwsm::io {

/// Writes what a log says as messages of ROS 2: /scan, /odom and the same on /tf, /tf_static for
/// where lasers sit, /imu, /ground_truth. Read as a log again it gives the same scans, with the
/// same odometry, bit for bit, unless stamps step back: a bag is read in their order.
class LogBagWriter {
 public:
  /// Writes into a bag, which outlives this.
  explicit LogBagWriter(BagFile& bag) : bag_(&bag) {}

  /// Writes a record. @throws WriteError where ROS 2 has no such time.
  void Write(const LogRecord& record);

 private:
  void WriteScan(const ScanReading& reading);
  void WriteOdometry(Timestamp stamp, const Pose2& T_odom_robot);
  void WriteTruth(const TruePoseReading& reading);
  void WriteImu(const ImuReading& reading);
  void WriteMounting(Timestamp stamp, const std::string& frame, const Pose2& T_robot_laser);

  BagFile* bag_;
  std::map<std::string, Pose2> T_robot_laser_;  // As written last, by frame.
};

}  // namespace qwsm::io
