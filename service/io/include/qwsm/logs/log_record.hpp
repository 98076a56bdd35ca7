// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/imu_reading.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::io {

/// One sweep of one laser, with the odometry of its moment where the log has any.
struct ScanReading {
  LaserScan scan;
  std::optional<Pose2> T_odom_robot;
  /// Name of the laser: "front", "rear", "laser3" (CARMEN), "laser:0" (Player).
  std::string laser;
  /// Odometry at the last beam, of a scan that is as it was measured (LogOptions::as_measured).
  std::optional<Pose2> T_odom_end{};
};

/// The robot's own dead reckoning.
struct OdometryReading {
  Timestamp stamp{};
  Pose2 T_odom_robot;
};

/// Where a simulator says the robot is.
struct TruePoseReading {
  Timestamp stamp{};
  Pose2 T_world_robot;
  std::optional<Pose2> T_odom_robot;
};

/// What a log says, one message at a time, in the order of the file. Readings of an inertial sensor
/// are about the robot's axes.
using LogRecord = std::variant<ScanReading, OdometryReading, TruePoseReading, ImuReading>;

}  // namespace qwsm::io
