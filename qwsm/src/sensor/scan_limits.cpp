// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/scan_limits.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace qwsm {

float RangeMaximumOf_m(float stated_m) {
  return stated_m == std::numeric_limits<float>::infinity() ? kLongestRange_m : stated_m;
}

std::chrono::nanoseconds StatedSweep(double stated_s) {
  constexpr double kLongestSweep_s = 1.0;
  if (!(stated_s > 0.0 && stated_s <= kLongestSweep_s)) return {};
  return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(stated_s));
}

bool IsMounting(const Pose2& T_robot_laser) {
  return IsFinite(T_robot_laser) &&
         T_robot_laser.translation_m().norm() <= static_cast<double>(kLongestRange_m);
}

std::string_view ObjectionTo(const LaserScan& scan) {
  const LaserGeometry& geometry = scan.geometry;
  if (scan.ranges_m.empty()) return "the scan has no beams";
  if (scan.size() > kMostBeams) return "the scan has more than 100000 beams";
  const double turn_rad = scan.size() > 1 ? std::abs(geometry.Bearing(1) - geometry.Bearing(0)) : 0;
  if (!std::isfinite(geometry.first_bearing_rad) || !std::isfinite(geometry.bearing_step_rad) ||
      !(turn_rad * static_cast<double>(scan.size() - 1) <= 4.0 * std::numbers::pi)) {
    return "the scan's bearings are not finite, or go round more than twice";
  }
  if (scan.size() > 1 && std::abs(geometry.bearing_step_rad) < kLeastBearingStep_rad) {
    return "the scan's beams look all in one direction: there is no angle between them";
  }
  if (!(geometry.range_min_m >= 0.0F && geometry.range_min_m < geometry.range_max_m)) {
    return "the scan's range limits are not 0 <= minimum < maximum";
  }
  if (geometry.range_max_m > kLongestRange_m) return "the scan's range maximum is above 1 km";
  if (!IsMounting(geometry.T_robot_laser)) {
    return "the laser's mounting is not finite, or more than 1 km off the robot";
  }
  return {};
}

}  // namespace qwsm
