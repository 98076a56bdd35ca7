// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm {

/// One odometry reading of a log, and the pose that was estimated there if a scan was taken.
struct CarriedReading {
  Timestamp stamp{};
  Pose2 T_odom_robot;
  std::optional<Pose2> T_map_robot = std::nullopt;
};

/// A pose for every reading from the first estimated one on, so that poses estimated at scans can
/// be asked for at the stamps of the odometry between them: odometry carries the estimates before
/// and after to the reading, and the two are blended by how many readings lie on either side. The
/// order of `readings` is the order of measurement, whatever the stamps say.
Trajectory CarryByOdometry(std::span<const CarriedReading> readings);

}  // namespace qwsm
