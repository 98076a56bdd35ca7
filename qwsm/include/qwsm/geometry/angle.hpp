// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace qwsm {

/// The angle in (-pi, pi] that points where `angle_rad` points. Differences of angles go through
/// here.
inline double NormalizeAngle(double angle_rad) {
  if (angle_rad > -std::numbers::pi && angle_rad <= std::numbers::pi) return angle_rad;
  const double wrapped_rad = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped_rad <= -std::numbers::pi ? std::numbers::pi : wrapped_rad;
}

constexpr double DegreesToRadians(double angle_deg) { return angle_deg * std::numbers::pi / 180.0; }
constexpr double RadiansToDegrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

}  // namespace qwsm
