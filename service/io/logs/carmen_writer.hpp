// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <map>
#include <string>

#include "qwsm/logs/log_record.hpp"

namespace qwsm::io {

/// Says how scans are written.
enum class CarmenDialect {
  kRobotLaser,  ///< ROBOTLASER: states the bearings and the maximum range.
  kFlaser,      ///< FLASER, for older programs: right for 180 degrees only.
};

/// Whether programs that read the scan as FLASER, which tells no bearings, guess them rightly.
bool IsGuessedRightly(const LaserScan& scan);

/// Writes a CARMEN log that OpenLog reads back to the same records.
///
/// Numbers have all their digits. Not part of the format, and so lost, are the minimum range and,
/// with kFlaser, bearings and maximum range. A scan without odometry becomes RAWLASER, which has
/// none.
class CarmenWriter {
 public:
  /// Writes the heading. The stream must outlive this; whether it took everything is its own to
  /// say.
  explicit CarmenWriter(std::ostream& stream, CarmenDialect dialect = CarmenDialect::kRobotLaser);

  void Write(const LogRecord& record);

 private:
  void WriteScan(const ScanReading& reading);
  void WriteOdometry(const OdometryReading& reading);
  void WriteTruePose(const TruePoseReading& reading);
  void WriteImu(const ImuReading& reading);
  void WriteMounting(int laser_number, const Pose2& T_robot_laser);
  void AppendStampAndHost(Timestamp stamp);

  std::ostream* stream_;
  CarmenDialect dialect_;
  std::optional<Timestamp> first_stamp_;
  std::map<int, Pose2> T_robot_laser_;  // Mountings as they were written, by the laser's number.
  std::string line_;
};

}  // namespace qwsm::io
