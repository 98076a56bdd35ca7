// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/sensor/gyro_track.hpp"
#include "qwsm/sensor/stamp_check.hpp"
#include "qwsm/sensor/turn_check.hpp"
#include "service/pipeline/run/scan_source.hpp"

namespace qwsm::pipeline {

/// The scans of recorded logs, one log after the other as parts of one recording.
class LogSource final : public ScanSource {
 public:
  /// Opens all logs at once, so that a wrong name is found before the work begins.
  /// @throws io::LogError where one is no log.
  LogSource(const std::vector<std::filesystem::path>& logs, const io::LogOptions& options);

  /// Gives the next scan.
  /// @throws io::LogError where a log is damaged, after everything before the damage was given.
  std::optional<Observation> Next() override;
  SourceProgress progress() const override;
  const Trajectory& truth() const override { return truth_; }

  /// The observation that Next() will give; null at the end.
  const Observation* Peek();

  /// Odometry at the last beam of the scan that Next() gave last, where scans are as measured.
  const std::optional<Pose2>& T_odom_end() const { return T_odom_end_; }
  /// What the inertial sensor felt since the scan before, up to the first reading that is not
  /// before the end of the scan that Next() gave last.
  const std::vector<ImuReading>& imu() const { return imu_; }
  /// Whether the logs had an inertial sensor so far.
  bool has_imu() const { return !gyro_.empty(); }

  /// Lines for the record: one per log, and one per kind of fault.
  std::vector<std::string> Describe() const override;

 private:
  std::optional<Observation> Read();
  std::optional<io::ScanReading> ReadScan();
  bool ReadRecord();
  void CheckOrder(Timestamp stamp);
  void Check(const Observation& observation);
  void CheckStamps(const Observation& observation);

  std::function<void(const std::string&)> warn_;
  bool mirrored_;
  TurnCheck turns_;
  bool told_of_turns_ = false;
  StampCheck stamps_;
  bool told_of_stamps_ = false;
  double stamp_offset_s_;
  std::vector<std::unique_ptr<io::LogReader>> readers_;
  std::size_t current_ = 0;
  std::size_t last_log_ = 0;             // Which the last scan is of.
  std::optional<Timestamp> last_stamp_;  // Of that scan.
  std::size_t scans_ = 0;
  std::optional<Observation> ahead_;  // Observation that was peeked at.
  Trajectory truth_;
  std::deque<io::ScanReading> held_;  // Scans whose turn by the gyro is to be read yet.
  std::exception_ptr failure_;        // To be thrown when these are given.
  GyroTrack gyro_;
  std::vector<ImuReading> imu_read_;  // Since Next() gave a scan.
  std::vector<ImuReading> imu_;
  std::optional<Pose2> T_odom_end_read_;  // Of the scan that was read last.
  std::optional<Pose2> T_odom_end_;       // Of the one that Next() gave.
};

}  // namespace qwsm::pipeline
