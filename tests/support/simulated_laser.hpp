// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <numbers>
#include <random>

#include "qwsm/sensor/laser_scan.hpp"
#include "tests/support/world.hpp"

namespace qwsm::test {

/// A laser that measures a World. The default is like the SICK LMS-200 of the recorded logs.
struct SimulatedLaser {
  std::size_t beams = 361;
  double field_of_view_rad = std::numbers::pi;  ///< Symmetric about straight ahead.
  double range_min_m = 0.05;
  double range_max_m = 30.0;
  double range_sigma_m = 0.01;
  double bearing_sigma_rad = 0.002;
  double lost_echo_share = 0.002;  ///< Of the beams that hit something.
  Pose2 T_robot_laser = {};
};

LaserGeometry GeometryOf(const SimulatedLaser& laser);

/// What the laser reads where the robot is: every beam cast exactly along a bearing with noise,
/// then noise on its range. Misses read `range_max_m`.
LaserScan Measure(const SimulatedLaser& laser,
                  const World& world,
                  const Pose2& T_world_robot,
                  std::mt19937_64& random);

}  // namespace qwsm::test
