// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/mapping/observation.hpp"
#include "tests/support/room_log.hpp"

namespace qwsm::test {

/// What a robot in the room measures at scan number `scan`, 181 beams, with perfect odometry.
inline Observation ObservationInRoom(int scan) {
  const Pose2 T_world_robot = PoseInRoom(scan);
  Observation observation;
  observation.scan.stamp = std::chrono::milliseconds(100 * scan);
  observation.scan.geometry = {.first_bearing_rad = -1.5708F,
                               .bearing_step_rad = 0.017453F,
                               .range_min_m = 0.1F,
                               .range_max_m = 30.0F,
                               .T_robot_laser = {0.2, 0.0, 0.0}};
  const Pose2 T_world_laser = T_world_robot * observation.scan.geometry.T_robot_laser;
  for (std::size_t beam = 0; beam < 181; ++beam) {
    const double bearing_rad = T_world_laser.theta_rad + observation.scan.geometry.Bearing(beam);
    observation.scan.ranges_m.push_back(
        static_cast<float>(RangeInRoom_m(T_world_laser.translation_m(), bearing_rad)));
  }
  observation.T_odom_robot = T_world_robot;
  return observation;
}

}  // namespace qwsm::test
