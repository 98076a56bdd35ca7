// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// What a robot tells at one moment.
struct Observation {
  LaserScan scan;
  std::optional<Pose2> T_odom_robot{};  ///< Odometry at the scan's stamp, if there is any.
  /// Angle turned since some moment as a gyro tells it, at the scan's stamp; not wrapped.
  std::optional<double> gyro_rad{};
};

}  // namespace qwsm
