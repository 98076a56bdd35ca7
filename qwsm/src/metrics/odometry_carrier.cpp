// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/odometry_carrier.hpp"

#include <algorithm>

namespace qwsm {
namespace {

using Readings = std::span<const CarriedReading>;

Pose2 Carry(const CarriedReading& from, const CarriedReading& to) {
  return *from.T_map_robot * (from.T_odom_robot.Inverse() * to.T_odom_robot);
}

Readings::iterator NextEstimate(Readings::iterator from, Readings readings) {
  return std::find_if(from, readings.end(), [](const CarriedReading& reading) {
    return reading.T_map_robot.has_value();
  });
}

}  // namespace

Trajectory CarryByOdometry(Readings readings) {
  Trajectory trajectory;
  auto before = NextEstimate(readings.begin(), readings);
  while (before != readings.end()) {
    const auto after = NextEstimate(std::next(before), readings);
    trajectory.push_back({.stamp = before->stamp, .T_map_robot = *before->T_map_robot});
    for (auto reading = std::next(before); reading != after; ++reading) {
      Pose2 T_map_robot = Carry(*before, *reading);
      if (after != readings.end()) {
        const double share =
            static_cast<double>(reading - before) / static_cast<double>(after - before);
        T_map_robot = Between(T_map_robot, Carry(*after, *reading), share);
      }
      trajectory.push_back({.stamp = reading->stamp, .T_map_robot = T_map_robot});
    }
    before = after;
  }
  return trajectory;
}

}  // namespace qwsm
