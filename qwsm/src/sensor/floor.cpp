// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/floor.hpp"

#include <cmath>
#include <limits>

namespace qwsm {
namespace {

constexpr double kClear = 3.0;           // Standard deviations.
constexpr double kHeightSigma_m = 0.01;  // As well as a height is measured, and tires are filled.

}  // namespace

std::size_t LeaveOutFloor(const Tilt& tilt, double height_m, LaserScan& scan) {
  const Eigen::Vector3d& up = tilt.up_robot;
  if (up.head<2>().norm() <= kClear * tilt.sigma_rad) return 0;
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  const double laser_above_m =
      up.dot(Eigen::Vector3d(T_robot_laser.x_m, T_robot_laser.y_m, height_m));
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (StateOf(scan.ranges_m[i], scan.geometry) != BeamState::kHit) continue;
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    const double bearing_rad = T_robot_laser.theta_rad + scan.geometry.Bearing(i);
    const double climb = up.x() * std::cos(bearing_rad) + up.y() * std::sin(bearing_rad);
    const double end_above_m = laser_above_m + range_m * climb;
    const double sigma_m = std::hypot(kHeightSigma_m, range_m * tilt.sigma_rad);
    if (climb >= 0.0 || end_above_m > kClear * sigma_m) continue;
    scan.ranges_m[i] = std::numeric_limits<float>::quiet_NaN();
    ++left_out;
  }
  return left_out;
}

}  // namespace qwsm
