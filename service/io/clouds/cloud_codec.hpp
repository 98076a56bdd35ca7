// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "slam6d/cloud/point_cloud.hpp"

namespace slam6d::io {

/// What a journal keeps of a 3D scan: all that its registration began with, to the last bit.
struct JournaledCloud {
  PointCloud cloud;  ///< Points in the sensor's frame, in metres.
  Pose3 T_robot_sensor;
  Pose3 T_odom_sensor;                ///< Estimate that the registration began with.
  std::optional<Pose3> T_odom_robot;  ///< Odometry for the robot to go on from.
  std::optional<Pose3> T_slam_odom;   ///< Where odometry began anew, or the start was told.
};

/// Kind of the journals that keep these; see qwsm::io::JournalFile.
inline constexpr std::string_view kCloudJournal = "3D scans, version 1";

std::string EncodeCloud(const JournaledCloud& scan);
/// Reads a scan from bytes.
/// @throws qwsm::io::BinaryError where there is no scan, or one with poses that are not finite.
JournaledCloud DecodeCloud(std::string_view bytes);

}  // namespace slam6d::io
