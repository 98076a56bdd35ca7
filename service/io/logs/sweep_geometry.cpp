// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/sweep_geometry.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

constexpr double kFullCircle_rad = 2.0 * std::numbers::pi;

/// A scanner known by how many readings it gives.
struct KnownScanner {
  std::size_t readings;
  double first_bearing_deg;
  double step_deg;
};

constexpr double kUrgStep_deg = 360.0 / 1024.0;
constexpr std::array kKnownScanners{
    KnownScanner{180, -90.0, 1.0},     // SICK LMS 2xx, the last beam left out.
    KnownScanner{181, -90.0, 1.0},     // SICK LMS 2xx.
    KnownScanner{360, -90.0, 0.5},     //
    KnownScanner{361, -90.0, 0.5},     //
    KnownScanner{400, -50.0, 0.25},    //
    KnownScanner{401, -50.0, 0.25},    //
    KnownScanner{541, -135.0, 0.5},    // SICK LMS 1xx.
    KnownScanner{1081, -135.0, 0.25},  // Hokuyo UTM-30LX.
    KnownScanner{682, -340.5 * kUrgStep_deg, kUrgStep_deg},  // Hokuyo URG-04LX, 240 degrees.
    KnownScanner{683, -341.0 * kUrgStep_deg, kUrgStep_deg},
    KnownScanner{726, -362.5 * kUrgStep_deg, kUrgStep_deg},
};

LaserGeometry MakeGeometry(double first_bearing_rad, double step_rad) {
  return {.first_bearing_rad = static_cast<float>(first_bearing_rad),
          .bearing_step_rad = static_cast<float>(step_rad),
          .range_min_m = kNearestReading_m,
          .T_robot_laser = {}};
}

}  // namespace

LaserGeometry GuessGeometry(std::size_t readings, std::optional<double> field_of_view_rad) {
  if (!field_of_view_rad) {
    for (const KnownScanner& scanner : kKnownScanners) {
      if (scanner.readings != readings) continue;
      return MakeGeometry(DegreesToRadians(scanner.first_bearing_deg),
                          DegreesToRadians(scanner.step_deg));
    }
  }
  const double span_rad = field_of_view_rad.value_or(std::numbers::pi);
  const std::size_t steps = readings > 1 ? readings - 1 : 1;
  return MakeGeometry(-0.5 * span_rad, span_rad / static_cast<double>(steps));
}

std::optional<double> BearingStep(double span_rad, double stated_step_rad, std::size_t readings) {
  constexpr double kSlack = 1.01;  // Rounded to a few digits, or a beam too many.
  if (!std::isfinite(span_rad) || !std::isfinite(stated_step_rad)) return std::nullopt;
  if (std::abs(span_rad) > kSlack * kFullCircle_rad) return std::nullopt;
  if (std::abs(stated_step_rad) > kSlack * kFullCircle_rad) return std::nullopt;
  if (readings < 2) return stated_step_rad;
  const double closed_rad = span_rad / static_cast<double>(readings - 1);
  const double open_rad = span_rad / static_cast<double>(readings);
  const auto agrees = [&](double step_rad) {
    // Half way between the two would no longer tell them apart.
    return std::abs(step_rad - stated_step_rad) < 0.4 * std::abs(closed_rad - open_rad);
  };
  if (span_rad != 0.0 && (stated_step_rad == 0.0 || agrees(closed_rad))) return closed_rad;
  if (span_rad != 0.0 && agrees(open_rad)) return open_rad;
  // The resolution alone: a scanner that left beams out, or a field of view rounded or not stated.
  const double swept_rad = std::abs(stated_step_rad) * static_cast<double>(readings - 1);
  if (stated_step_rad == 0.0 || swept_rad > kSlack * kFullCircle_rad) return std::nullopt;
  return stated_step_rad;
}

void Mirror(LaserGeometry& geometry) {
  geometry.first_bearing_rad = -geometry.first_bearing_rad;
  geometry.bearing_step_rad = -geometry.bearing_step_rad;
}

float StatedRangeMaximum(double range_max_m) {
  const bool is_one = range_max_m > static_cast<double>(kNearestReading_m) &&
                      range_max_m <= static_cast<double>(kLongestRange_m);
  return is_one ? static_cast<float>(range_max_m) : 0.0F;
}

}  // namespace qwsm::io
