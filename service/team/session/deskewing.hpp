// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/sensor/deskew.hpp"
#include "service/team/scans/cloud_scan.hpp"
#include "service/team/session/odometry_buffer.hpp"

namespace qwsm::team {

/// When the last beam of a scan was measured, as far as that is known.
inline Timestamp EndOf(const LaserScan& scan) { return scan.stamp + scan.sweep; }
/// Clouds have no times of their points.
inline Timestamp EndOf(const CloudScan& scan) { return scan.stamp; }

/// The scan as from the place of its first beam, where its beams have times and odometry tells how
/// the robot moved meanwhile; else the scan itself.
inline LaserScan AsFromOnePlace(LaserScan scan, const OdometryBuffer<Pose2>& odometry) {
  if (scan.sweep.count() <= 0) return scan;
  const std::optional<Pose2> T_odom_first = odometry.At(scan.stamp);
  const std::optional<Pose2> T_odom_last = odometry.At(EndOf(scan));
  if (!T_odom_first || !T_odom_last) return scan;
  return Deskewed(scan, T_odom_first->Inverse() * *T_odom_last);
}
inline CloudScan AsFromOnePlace(CloudScan scan, const OdometryBuffer<slam6d::Pose3>&) {
  return scan;
}

}  // namespace qwsm::team
