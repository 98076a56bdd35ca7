// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include "sim/random.hpp"
#include "sim/solid_world.hpp"
#include "slam6d/cloud/point_cloud.hpp"

namespace sim {

/// A 2D laser scanner that nods, as on Kurt3D (Nüchter et al. 2007, section 2.2).
struct PitchingLaserOptions {
  int beams = 181;  ///< Beams of a sweep, over its width.
  double width_rad = std::numbers::pi;
  int sweeps = 256;
  double height_rad = 2.0 * std::numbers::pi / 3.0;
  double max_range_m = 30.0;
  double noise_m = 0.01;  ///< Standard deviation of a range.
  double mount_height_m = 0.5;
};

template <class Visitor>
void Describe(Visitor& visit, PitchingLaserOptions& o) {
  visit("beams", o.beams, {.help = "of a sweep", .min = 2, .max = 10000});
  visit("width_rad", o.width_rad, {.help = "of a sweep", .min = 0.1, .max = 6.284});
  visit("sweeps", o.sweeps, {.help = "of a scan", .min = 2, .max = 10000});
  visit(
      "height_rad", o.height_rad, {.help = "between first and last sweep", .min = 0.1, .max = 3.2});
  visit(
      "max_range_m", o.max_range_m, {.help = "farther things are not seen", .min = 1, .max = 1e3});
  visit("noise_m", o.noise_m, {.help = "standard deviation of a range", .min = 0, .max = 1});
  visit("mount_height_m", o.mount_height_m, {.help = "above the ground", .min = 0.05, .max = 10});
}

/// Takes a scan from a pose: all beams that came back, in the scanner's frame.
slam6d::PointCloud Scan(const SolidWorld& world,
                        const slam6d::Pose3& T_world_laser,
                        const PitchingLaserOptions& options,
                        RandomEngine& random);

}  // namespace sim
