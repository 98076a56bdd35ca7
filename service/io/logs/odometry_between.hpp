// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "qwsm/logs/log_record.hpp"

namespace qwsm::io {

/// Between readings of odometry; what happens within a longer gap is unknown.
inline constexpr Timestamp kLongestGap = std::chrono::seconds(2);
/// Beyond the first or last reading, which then stands for it.
inline constexpr Timestamp kLongestReach = std::chrono::milliseconds(200);

/// The odometry of a moment between two readings, by even motion of each coordinate.
inline Pose2 Between(const OdometryReading& before, const OdometryReading& after, Timestamp stamp) {
  const Timestamp span = after.stamp - before.stamp;
  if (span == Timestamp::zero()) return before.T_odom_robot;
  const double share =
      static_cast<double>((stamp - before.stamp).count()) / static_cast<double>(span.count());
  return qwsm::Between(before.T_odom_robot, after.T_odom_robot, share);
}

}  // namespace qwsm::io
