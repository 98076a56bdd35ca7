// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/gyro.hpp"

#include <cmath>

namespace sim {

void Gyro::Advance(double yaw_rate_rad_s, std::chrono::duration<double> duration) {
  const double seconds = duration.count();
  const double root_seconds = std::sqrt(seconds);
  turned_rad_ += (yaw_rate_rad_s + bias_rad_s_) * seconds +
                 options_.noise_rad_per_sqrt_s * root_seconds * standard_normal_(random_);
  bias_rad_s_ += options_.bias_walk_rad_s * root_seconds * standard_normal_(random_);
}

}  // namespace sim
