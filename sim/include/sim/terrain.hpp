// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/geometry/pose2.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace sim {

/// Ground with slopes and steps.
struct TerrainOptions {
  double steepest = 0.05;  ///< Steepest slope of the hills, as rise over run.
  double wavelength_m = 25.0;
  double step_height_m = 0.08;
  double step_spacing_m = 7.0;  ///< Distance of steps along x, up and down in turn.
};

template <class Visitor>
void Describe(Visitor& visit, TerrainOptions& o) {
  visit("steepest", o.steepest, {.help = "rise over run of the hills", .min = 0, .max = 1});
  visit("wavelength_m", o.wavelength_m, {.help = "from hill to hill", .min = 1, .max = 1e4});
  visit("step_height_m", o.step_height_m, {.help = "of a step", .min = 0, .max = 1});
  visit("step_spacing_m",
        o.step_spacing_m,
        {.help = "between steps, which lead up and down in turn", .min = 0.5, .max = 1e4});
}

/// The height of the ground, and how a robot stands on it.
class Terrain {
 public:
  explicit Terrain(const TerrainOptions& options) : options_(options) {}

  double HeightM(const Eigen::Vector2d& p_world_m) const;
  /// Limit of the height: the ground is nowhere higher, nor deeper than this below 0.
  double HighestM() const;

  /// The pose of a robot that has a heading and stands on four wheels.
  slam6d::Pose3 Stand(const qwsm::Pose2& T_world_robot) const;

 private:
  TerrainOptions options_;
};

}  // namespace sim
