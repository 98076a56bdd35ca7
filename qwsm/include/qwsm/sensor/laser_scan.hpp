// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/timestamp.hpp"

namespace qwsm {

/// Where the beams of a scan point. Single precision, as sensors and sensor_msgs/LaserScan have it,
/// so that a scan survives the wire bit for bit.
struct LaserGeometry {
  float first_bearing_rad = 0.0F;  ///< Bearing of beam 0 in the laser frame.
  /// Angle between neighbouring beams; negative for a scanner that turns clockwise.
  float bearing_step_rad = 0.0F;
  float range_min_m = 0.0F;  ///< Readings below are too near to be trusted.
  float range_max_m = 0.0F;  ///< Readings near it and beyond mean "no echo"; see StateOf().
  Pose2 T_robot_laser;

  double Bearing(std::size_t beam) const {
    return static_cast<double>(first_bearing_rad) +
           static_cast<double>(beam) * static_cast<double>(bearing_step_rad);
  }

  friend bool operator==(const LaserGeometry&, const LaserGeometry&) = default;
};

/// What one reading says.
enum class BeamState {
  kHit,      ///< A surface was measured.
  kMiss,     ///< No echo within the range: the way is free, how far is not known.
  kTooNear,  ///< A reading below the range minimum: dust, the robot itself, or a failed one.
  kInvalid,  ///< The reading is not a number.
};

/// One sweep of a planar laser.
struct LaserScan {
  Timestamp stamp{};
  LaserGeometry geometry;
  std::vector<float> ranges_m;  ///< One reading per beam, in the order of the bearings.
  /// Time from the first beam to the last; 0 where that is not known, or does not count any more.
  std::chrono::nanoseconds sweep{};
  /// The same of a scan that odometry has brought to one place (Deskewed()): what it did not feel
  /// of the motion is left.
  std::chrono::nanoseconds deskewed_sweep{};
  double height_m = 0.0;  ///< Of the laser above the floor; 0 where it is not known.

  std::size_t size() const { return ranges_m.size(); }
};

/// Time from the first beam to the last, whether or not odometry has brought them to one place.
inline std::chrono::nanoseconds SweepOf(const LaserScan& scan) {
  return std::max(scan.sweep, scan.deskewed_sweep);
}

/// A reading at this share of the maximum range or above is a miss: scanners report "no echo" as a
/// value near their maximum, not as the maximum itself.
inline constexpr float kMissShareOfMaximum = 0.97F;

/// Tells what a reading says, by the range limits of its laser.
inline BeamState StateOf(float range_m, const LaserGeometry& geometry) {
  if (std::isnan(range_m)) return BeamState::kInvalid;
  if (range_m <= 0.0F || range_m < geometry.range_min_m) return BeamState::kTooNear;
  if (range_m >= kMissShareOfMaximum * geometry.range_max_m) return BeamState::kMiss;
  return BeamState::kHit;
}

}  // namespace qwsm
