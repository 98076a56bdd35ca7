// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/logs/log_record.hpp"
#include "qwsm/sensor/gyro_track.hpp"
#include "service/team/session/odometry_buffer.hpp"
#include "service/team/session/robot_listener.hpp"

namespace qwsm::pipeline {

/// Writes what a robot says as a log, each scan with the odometry of its moment. Its lasers are
/// told apart by where they sit, and named in the order they are heard.
class ScanRecorder final : public team::RobotListener<team::Planar> {
 public:
  using Write = std::function<void(const io::LogRecord&)>;

  /// Hands over what is complete. @param write puts a record into a log.
  explicit ScanRecorder(Write write) : write_(std::move(write)) {}

  bool TakeScan(std::string_view robot, LaserScan scan) override;
  void TakeOdometry(std::string_view robot, Timestamp stamp, const Pose2& T_odom_robot) override;
  void ExpectOdometry(std::string_view robot, bool expected) override;
  void TakeImu(std::string_view robot, const ImuReading& reading) override;
  void PlaceAt(std::string_view, const UncertainPose2&) override {}

  /// Writes the scans whose odometry is known, or will not come.
  void WriteReady();
  /// Writes all scans, with odometry or without.
  void Finish();

  std::size_t scans() const { return scans_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    LaserScan scan;
    Clock::time_point arrived;
  };

  static constexpr std::size_t kImuReadingsKept = 4096;

  void WriteFirst();
  std::string NameOf(const Pose2& T_robot_laser);

  Write write_;
  team::OdometryBuffer<Pose2> odometry_;
  GyroTrack gyro_{kImuReadingsKept};
  bool expects_odometry_ = false;
  std::deque<Waiting> waiting_;
  std::vector<Pose2> T_robot_laser_;  // Of the lasers heard.
  std::size_t scans_ = 0;
};

}  // namespace qwsm::pipeline
