// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "qwsm/sensor/laser_scan.hpp"
#include "slam6d/cloud/point_cloud.hpp"

namespace qwsm::team {

/// One 3D scan of a robot.
struct CloudScan {
  Timestamp stamp{};
  slam6d::PointCloud cloud;      ///< Points in the sensor's frame, in metres.
  slam6d::Pose3 T_robot_sensor;  ///< Where the sensor sits on the robot.
};

/// A 3D scan and where odometry had the robot then.
struct CloudObservation {
  CloudScan scan;
  std::optional<slam6d::Pose3> T_odom_robot;
};

/// A scan of a robot's model, and all that its registration began with: from these, in their order,
/// the model is built once more to the last bit.
struct KeptCloud {
  std::string robot;
  std::uint64_t sequence = 0;  ///< Number that grows with the scans of the robot.
  std::shared_ptr<const CloudScan> scan;
  slam6d::Pose3 T_odom_sensor;                ///< Estimate that the registration began with.
  std::optional<slam6d::Pose3> T_odom_robot;  ///< Odometry for the robot to go on from.
  /// Where odometry began anew, or the start was told; nothing where odometry is as it was
  /// published.
  std::optional<slam6d::Pose3> T_slam_odom;
};

/// Most points of one scan; more are a mistake or an attack.
inline constexpr std::size_t kMaxCloudPoints = 20'000'000;

/// Says why a scan must not be registered; empty if it may.
std::string_view ObjectionTo(const CloudScan& scan);
}  // namespace qwsm::team
