// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/terrain.hpp"

#include <cmath>
#include <numbers>

namespace sim {
namespace {

// From the middle of a robot to its axles, and to its wheels on either side.
constexpr double kHalfLength_m = 0.2;
constexpr double kHalfWidth_m = 0.2;

}  // namespace

double Terrain::HeightM(const Eigen::Vector2d& p_world_m) const {
  const double k = 2.0 * std::numbers::pi / options_.wavelength_m;
  const double hills_m =
      options_.steepest / k * std::sin(k * p_world_m.x()) * std::cos(k * p_world_m.y());
  const double stair = std::floor(p_world_m.x() / options_.step_spacing_m);
  const bool is_raised = std::abs(std::fmod(stair, 2.0)) > 0.5;
  return hills_m + (is_raised ? options_.step_height_m : 0.0);
}

double Terrain::HighestM() const {
  return options_.steepest * options_.wavelength_m / (2.0 * std::numbers::pi) +
         options_.step_height_m;
}

slam6d::Pose3 Terrain::Stand(const qwsm::Pose2& T_world_robot) const {
  const auto height_m = [&](double forward_m, double left_m) {
    return HeightM(T_world_robot * Eigen::Vector2d(forward_m, left_m));
  };
  const double front_m = height_m(kHalfLength_m, 0.0);
  const double back_m = height_m(-kHalfLength_m, 0.0);
  const double left_m = height_m(0.0, kHalfWidth_m);
  const double right_m = height_m(0.0, -kHalfWidth_m);
  const double roll_rad = std::atan2(left_m - right_m, 2.0 * kHalfWidth_m);
  const double pitch_rad = -std::atan2(front_m - back_m, 2.0 * kHalfLength_m);
  return {
      .rotation = slam6d::RotationFromRollPitchYaw({roll_rad, pitch_rad, T_world_robot.theta_rad}),
      .translation_m = {
          T_world_robot.x_m, T_world_robot.y_m, 0.25 * (front_m + back_m + left_m + right_m)}};
}

}  // namespace sim
