// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/pitching_laser.hpp"

#include <cmath>
#include <random>

namespace sim {
namespace {

/// The i-th of so many angles, spread evenly over an opening about 0.
double Spread(int i, int count, double opening_rad) {
  return opening_rad * (static_cast<double>(i) / (count - 1) - 0.5);
}

}  // namespace

slam6d::PointCloud Scan(const SolidWorld& world,
                        const slam6d::Pose3& T_world_laser,
                        const PitchingLaserOptions& options,
                        RandomEngine& random) {
  std::normal_distribution<double> noise(0.0, options.noise_m);
  slam6d::PointCloud cloud;
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    const Eigen::Matrix3d R_laser_sweep = slam6d::RotationFromRollPitchYaw(
        {0.0, Spread(sweep, options.sweeps, options.height_rad), 0.0});
    for (int beam = 0; beam < options.beams; ++beam) {
      const double bearing_rad = Spread(beam, options.beams, options.width_rad);
      const Eigen::Vector3d direction =
          R_laser_sweep * Eigen::Vector3d(std::cos(bearing_rad), std::sin(bearing_rad), 0.0);
      const std::optional<double> range_m = world.Cast(
          {T_world_laser.translation_m, T_world_laser.rotation * direction}, options.max_range_m);
      if (range_m) cloud.push_back((*range_m + noise(random)) * direction);
    }
  }
  return cloud;
}

}  // namespace sim
