// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/simulated_laser.hpp"

#include <cmath>
#include <optional>

namespace qwsm::test {

LaserGeometry GeometryOf(const SimulatedLaser& laser) {
  const double steps = static_cast<double>(laser.beams) - 1.0;
  return {.first_bearing_rad = static_cast<float>(-0.5 * laser.field_of_view_rad),
          .bearing_step_rad = static_cast<float>(laser.field_of_view_rad / steps),
          .range_min_m = static_cast<float>(laser.range_min_m),
          .range_max_m = static_cast<float>(laser.range_max_m),
          .T_robot_laser = laser.T_robot_laser};
}

LaserScan Measure(const SimulatedLaser& laser,
                  const World& world,
                  const Pose2& T_world_robot,
                  std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const Pose2 T_world_laser = T_world_robot * laser.T_robot_laser;
  LaserScan scan{.stamp = {}, .geometry = GeometryOf(laser), .ranges_m = {}};
  for (std::size_t beam = 0; beam < laser.beams; ++beam) {
    // Every beam draws the same numbers, hit or not, so that a change of the world changes the
    // noise of no other beam.
    const double bearing_error_rad = laser.bearing_sigma_rad * normal(random);
    const double range_error_m = laser.range_sigma_m * normal(random);
    const bool is_lost = uniform(random) < laser.lost_echo_share;
    const double heading_rad =
        T_world_laser.theta_rad + scan.geometry.Bearing(beam) + bearing_error_rad;
    const Eigen::Vector2d direction(std::cos(heading_rad), std::sin(heading_rad));
    const std::optional<double> range_m = CastRay(world, T_world_laser.translation_m(), direction);
    const bool has_echo = range_m && *range_m < laser.range_max_m && !is_lost;
    const double reading_m = has_echo ? std::max(0.0, *range_m + range_error_m) : laser.range_max_m;
    scan.ranges_m.push_back(static_cast<float>(reading_m));
  }
  return scan;
}

}  // namespace qwsm::test
