// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>

#include "qwsm/geometry/quaternion.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// What an inertial sensor feels at a moment, about axes of its own, or, after OnRobot(), about
/// those of the robot: x forward, y left, z up.
struct ImuReading {
  Timestamp stamp{};
  Eigen::Vector3d turn_rate_rad_s = Eigen::Vector3d::Zero();
  /// Acceleration without gravity taken away: (0, 0, 9.81) at rest; nothing where it is not felt.
  std::optional<Eigen::Vector3d> acceleration_mps2{};
  /// Rotation of those axes in a level frame, where the sensor works it out.
  std::optional<Quaternion> orientation{};
};

/// The reading as felt by a sensor that sits level on the robot and looks ahead. One that does is
/// given back to the last bit.
/// @param robot_imu rotation of the sensor on the robot, of any length but 0.
ImuReading OnRobot(const ImuReading& reading, const Quaternion& robot_imu);

/// Says why a reading must not be used; empty if it may.
std::string_view ObjectionTo(const ImuReading& reading);

}  // namespace qwsm
