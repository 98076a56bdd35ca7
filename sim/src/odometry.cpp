// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/odometry.hpp"

#include <cmath>
#include <numbers>

namespace sim {
namespace {

/// The motion along a circular arc of this length that turns by this angle.
qwsm::Pose2 Arc(double length_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  const double chord_m =
      std::abs(half_rad) < 1e-6 ? length_m : length_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), turn_rad};
}

}  // namespace

WheelOdometry::WheelOdometry(const OdometryOptions& options,
                             const WheelDriveOptions& drive,
                             std::uint64_t seed)
    : travel_noise_m_(options.travel_noise_m),
      tick_m_(2.0 * std::numbers::pi * drive.wheel_radius_m / options.ticks_per_turn),
      effective_track_m_(drive.track_m * TurnFactor(drive)),
      random_(seed) {
  // From numbers of its own, so that the noise of a drive is the same however good its calibration.
  RandomEngine random(SeedFor("calibration", seed));
  const CalibrationOptions& sigmas = options.calibration;
  const double scale_error = sigmas.scale_sigma * standard_normal_(random);
  const double balance_error = sigmas.balance_sigma * standard_normal_(random);
  const double turn_error = sigmas.turn_sigma * standard_normal_(random);
  standard_normal_.reset();  // It draws in pairs, and would keep one for the noise.
  left_scale_ += options.left_radius_error + scale_error - 0.5 * balance_error;
  right_scale_ += options.right_radius_error + scale_error + 0.5 * balance_error;
  effective_track_m_ *= 1.0 + options.turn_factor_error + turn_error;
}

void WheelOdometry::Advance(const RimSpeeds& rims, std::chrono::duration<double> duration) {
  const double left_m = left_scale_ * Read(left_, rims.left_mps, duration);
  const double right_m = right_scale_ * Read(right_, rims.right_mps, duration);
  const qwsm::Pose2 T_before_after =
      Arc(0.5 * (left_m + right_m), (right_m - left_m) / effective_track_m_);
  T_odom_robot_ = T_odom_robot_ * T_before_after;
}

double WheelOdometry::Read(Encoder& encoder,
                           double rim_mps,
                           std::chrono::duration<double> duration) {
  const double turned_m = rim_mps * duration.count();
  const double sigma_m = travel_noise_m_ * std::sqrt(std::abs(turned_m));
  encoder.turned_m += turned_m + sigma_m * standard_normal_(random_);
  const double reading_m = tick_m_ * std::floor(encoder.turned_m / tick_m_);
  const double newly_m = reading_m - encoder.read_m;
  encoder.read_m = reading_m;
  return newly_m;
}

}  // namespace sim
