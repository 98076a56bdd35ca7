// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/sensor/deskew.hpp"
#include "qwsm/sensor/floor.hpp"
#include "qwsm/sensor/gyro_track.hpp"
#include "qwsm/sensor/tilt_track.hpp"
#include "service/team/scans/cloud_scan.hpp"
#include "service/team/session/odometry_buffer.hpp"

namespace qwsm::team {

/// When the last beam of a scan was measured, as far as that is known.
inline Timestamp EndOf(const LaserScan& scan) { return scan.stamp + scan.sweep; }
/// Clouds have no times of their points.
inline Timestamp EndOf(const CloudScan& scan) { return scan.stamp; }

/// The scan as from the place of its first beam, where its beams have times and odometry tells how
/// the robot moved meanwhile, and the gyro, where there is one, how it turned; else the scan
/// itself.
inline LaserScan AsFromOnePlace(LaserScan scan,
                                const OdometryBuffer<Pose2>& odometry,
                                const GyroTrack& gyro) {
  if (scan.sweep.count() <= 0) return scan;
  const std::optional<Pose2> T_odom_first = odometry.At(scan.stamp);
  const std::optional<Pose2> T_odom_last = odometry.At(EndOf(scan));
  if (!T_odom_first || !T_odom_last) return scan;
  Pose2 T_first_last = T_odom_first->Inverse() * *T_odom_last;
  const std::optional<double> gyro_first_rad = gyro.At(scan.stamp);
  const std::optional<double> gyro_last_rad = gyro.At(EndOf(scan));
  // Its bias does not count within a scan.
  if (gyro_first_rad && gyro_last_rad) {
    T_first_last.theta_rad = NormalizeAngle(*gyro_last_rad - *gyro_first_rad);
  }
  return Deskewed(scan, T_first_last);
}
/// The scan as if its beams had no times: as it was measured, nothing is to be mended.
inline LaserScan WithoutTimes(LaserScan scan) {
  scan.sweep = {};
  return scan;
}
inline CloudScan WithoutTimes(CloudScan scan) { return scan; }

/// Leaves out the beams that may have hit the floor; see LeaveOutFloor().
/// @param set_height_m of the laser, where that is set; 0: the scan tells it.
inline void LeaveOutFloorOf(const TiltTrack& tilt, double set_height_m, LaserScan& scan) {
  const std::optional<Tilt> at_scan = tilt.At(scan.stamp);
  const double height_m = set_height_m > 0.0 ? set_height_m : scan.height_m;
  if (at_scan && height_m > 0.0) LeaveOutFloor(*at_scan, height_m, scan);
}
/// The floor is part of a cloud.
inline void LeaveOutFloorOf(const TiltTrack&, double, CloudScan&) {}

inline CloudScan AsFromOnePlace(CloudScan scan,
                                const OdometryBuffer<slam6d::Pose3>&,
                                const GyroTrack&) {
  return scan;
}

}  // namespace qwsm::team
