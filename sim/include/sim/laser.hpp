// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <numbers>
#include <optional>

#include "qwsm/sensor/laser_scan.hpp"
#include "sim/physics_world.hpp"
#include "sim/random.hpp"

namespace sim {

/// Options of a laser; the defaults are a SICK LMS-200 with 181 beams over 180 degrees, as in
/// section 4.1 of Visser et al. (2009).
struct LaserOptions {
  int beams = 181;
  double field_of_view_rad = std::numbers::pi;  ///< Angle from the first beam to the last.
  double rate_hz = 10.0;
  double first_scan_s = 0.0;  ///< When its first scan begins: lasers need not fire together.
  double breaks_at_s = 1e6;   ///< It begins no scan from then on.
  /// Time from the first beam to the last; 0 takes all at once, without skew.
  double sweep_s = 0.0;
  double range_min_m = 0.05;
  double range_max_m = 81.9;     ///< Range that is read for "no echo".
  double useful_range_m = 78.0;  ///< Farther surfaces return no echo.
  double mount_x_m = 0.0;        ///< Place on the robot.
  double mount_y_m = 0.0;
  double mount_heading_rad = 0.0;
  double range_sigma_m = 0.01;
  /// Noise that grows with the range; adds in squares to range_sigma_m.
  double range_sigma_relative = 0.0;
  double bearing_sigma_rad = 0.0;
  double range_step_m = 0.0;         ///< Readings are rounded to multiples of it; 0 does not round.
  double dropout_probability = 0.0;  ///< Probability that a surface returns no echo.
};

template <class Visitor>
void Describe(Visitor& visit, LaserOptions& o) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  visit("beams", o.beams, {.help = "readings in one scan", .min = 1, .max = 100000});
  visit("field_of_view_rad",
        o.field_of_view_rad,
        {.help = "angle from the first beam to the last", .min = 0, .max = kTurn_rad});
  visit("rate_hz", o.rate_hz, {.help = "scans in a second", .min = 0.01, .max = 100});
  visit(
      "first_scan_s", o.first_scan_s, {.help = "when its first scan begins", .min = 0, .max = 1e6});
  visit("breaks_at_s",
        o.breaks_at_s,
        {.help = "it begins no scan from then on", .min = 0, .max = 1e6});
  visit(
      "sweep_s", o.sweep_s, {.help = "time from the first beam to the last", .min = 0, .max = 10});
  visit("range_min_m", o.range_min_m, {.help = "nearest reading to trust", .min = 0, .max = 100});
  visit("range_max_m", o.range_max_m, {.help = "what 'no echo' reads", .min = 0.1, .max = 1000});
  visit("useful_range_m",
        o.useful_range_m,
        {.help = "farther surfaces return no echo", .min = 0.1, .max = 1000});
  visit(
      "mount_x_m", o.mount_x_m, {.help = "laser ahead of the robot's centre", .min = -5, .max = 5});
  visit(
      "mount_y_m", o.mount_y_m, {.help = "laser left of the robot's centre", .min = -5, .max = 5});
  visit("mount_heading_rad",
        o.mount_heading_rad,
        {.help = "where the laser looks on the robot", .min = -kTurn_rad, .max = kTurn_rad});
  visit("range_sigma_m", o.range_sigma_m, {.help = "range noise", .min = 0, .max = 1});
  visit("range_sigma_relative",
        o.range_sigma_relative,
        {.help = "range noise that grows with the range, as a share of it", .min = 0, .max = 0.5});
  visit("bearing_sigma_rad",
        o.bearing_sigma_rad,
        {.help = "noise of a beam's direction", .min = 0, .max = 0.2});
  visit("range_step_m",
        o.range_step_m,
        {.help = "readings are multiples of it; 0 for any", .min = 0, .max = 1});
  visit("dropout_probability",
        o.dropout_probability,
        {.help = "share of surfaces that return no echo", .min = 0, .max = 1});
}

template <class Report>
void Validate(const LaserOptions& o, Report& report) {
  if (o.range_min_m >= o.useful_range_m) report("range_min_m", "must be below useful_range_m");
  // Farther echoes would be taken for misses.
  if (o.useful_range_m > static_cast<double>(qwsm::kMissShareOfMaximum) * o.range_max_m) {
    report("useful_range_m", "must not exceed 97 % of range_max_m, which stands for 'no echo'");
  }
  if (o.sweep_s * o.rate_hz > 1.0) {
    report("sweep_s", "must not be longer than the time between two scans");
  }
}

/// The geometry that the scans of such a laser carry.
qwsm::LaserGeometry GeometryOf(const LaserOptions& options);

/// A planar laser on a robot. Beam 0 looks right, the others follow counter-clockwise; scans bear
/// the time of beam 0.
class Laser {
 public:
  Laser(const LaserOptions& options, std::uint64_t seed);

  /// Starts a scan with the beams that are due at once.
  void Begin(const PhysicsWorld& world, BodyId robot, qwsm::Timestamp now);

  /// Casts the beams due up to `now` of a scan that was begun, the robot having moved straight
  /// since the last call.
  void Continue(const PhysicsWorld& world, BodyId robot, qwsm::Timestamp now);

  bool is_scanning() const { return is_scanning_; }

  /// The scan, once its last beam has been cast.
  std::optional<qwsm::LaserScan> Take();

 private:
  qwsm::Timestamp TimeOf(std::size_t beam) const;
  float Measure(const PhysicsWorld& world,
                BodyId robot,
                const qwsm::Pose2& T_world_laser,
                std::size_t beam);
  float Read(double range_m);

  LaserOptions options_;
  qwsm::LaserScan scan_;
  bool is_scanning_ = false;
  qwsm::Timestamp last_time_{};
  qwsm::Pose2 last_T_world_robot_;
  RandomEngine random_;
  std::normal_distribution<double> standard_normal_;
};

}  // namespace sim
