// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

#include "sim/random.hpp"

namespace sim {

struct GyroOptions {
  bool enabled = false;
  double noise_rad_per_sqrt_s = 2e-4;  ///< Angle random walk: sigma of the angle after one second.
  double bias_rad_s = 0.0;             ///< Bias at the start.
  double bias_walk_rad_s = 1e-5;       ///< Sigma of the bias's change in one second.
};

template <class Visitor>
void Describe(Visitor& visit, GyroOptions& o) {
  visit("enabled", o.enabled, {.help = "whether the robot has a gyro"});
  visit("noise_rad_per_sqrt_s",
        o.noise_rad_per_sqrt_s,
        {.help = "sigma of the angle turned after one second, in radians", .min = 0, .max = 1});
  visit("bias_rad_s", o.bias_rad_s, {.help = "bias at the start, in rad/s", .min = -1, .max = 1});
  visit("bias_walk_rad_s",
        o.bias_walk_rad_s,
        {.help = "sigma of the bias's change in one second, in rad/s", .min = 0, .max = 1});
}

/// An integrating gyro: the angle it has turned by, with white noise and a wandering bias.
class Gyro {
 public:
  Gyro(const GyroOptions& options, std::uint64_t seed)
      : options_(options), bias_rad_s_(options.bias_rad_s), random_(seed) {}

  void Advance(double yaw_rate_rad_s, std::chrono::duration<double> duration);

  /// Angle turned since the start as the gyro reads it; not wrapped.
  double turned_rad() const { return turned_rad_; }

 private:
  GyroOptions options_;
  double bias_rad_s_;
  double turned_rad_ = 0.0;
  RandomEngine random_;
  std::normal_distribution<double> standard_normal_;
};

}  // namespace sim
