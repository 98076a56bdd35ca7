// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "qwsm/logs/log_reader.hpp"
#include "qwsm/sensor/gyro_track.hpp"
#include "qwsm/sensor/tilt_track.hpp"
#include "service/io/bags/assembly/bag_survey.hpp"
#include "service/io/bags/assembly/robot_choice.hpp"

namespace qwsm::io {

/// Reads a bag as a log: survey -> choice of a robot -> its scans, odometry and true poses in the
/// order of their stamps; readings of an inertial sensor up to the first that is not before the
/// scan that follows, so that what it felt until then is known.
class BagReader final : public LogReader {
 public:
  /// Surveys bags that are parts of one recording: what one says once, as where a laser sits,
  /// counts for all. @throws LogError where one is none, or the options do not fit them.
  /// @pre there is one.
  BagReader(std::span<const std::filesystem::path> paths, const LogOptions& options);

  std::optional<LogRecord> Next() override;
  const LogReport& report() const override { return report_; }
  /// Progress in scans, not in bytes.
  LogProgress progress() const override;

 private:
  /// A scan, and the laser it is of.
  struct Place {
    MessagePlace scan;
    std::size_t laser = 0;
  };

  void TellOfOthers();
  void TakePlaces();
  void TellOfOdometry();
  void TellOfBearings(const LaserScanMessage& message, const std::string& topic);
  bool IsImuDue(Timestamp until) const;
  std::optional<LogRecord> NextScan();
  ScanReading ReadScan(const Place& place);
  void LeaveOutFloorOf(double height_m, LaserScan& scan);
  void TellOfFloor();
  void BringToOnePlace(ScanReading& reading) const;
  std::optional<OdometryReading> NextOf(const OdometryTrack& track,
                                        std::size_t next,
                                        Timestamp until) const;

  LogOptions options_;
  LogReport report_;
  BagFaults faults_;
  BagContents contents_;
  RobotChoice choice_;
  std::vector<Place> places_;  // In the order of their stamps.
  std::size_t next_scan_ = 0;
  std::size_t next_odometry_ = 0;
  std::size_t next_truth_ = 0;
  std::size_t next_imu_ = 0;
  GyroTrack gyro_;
  TiltTrack tilt_;
  std::size_t leaning_scans_ = 0;
  std::size_t floor_beams_ = 0;
  bool told_of_bearings_ = false;
  std::string buffer_;
};

}  // namespace qwsm::io
