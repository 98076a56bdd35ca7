// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

#include "qwsm/geometry/pose2.hpp"
#include "sim/random.hpp"
#include "sim/wheel_drive.hpp"

namespace sim {

/// How well the wheels were measured before the drive, as relative errors that stay the same during
/// it: what UMBmark tells apart (Borenstein and Feng 1996). Each robot draws its own by the seed.
struct CalibrationOptions {
  double scale_sigma = 0.005;    ///< Error of the mean radius of all wheels.
  double balance_sigma = 0.002;  ///< Error of the right wheels' radius over the left ones'.
  double turn_sigma = 0.02;      ///< Error of the effective track.
};

template <class Visitor>
void Describe(Visitor& visit, CalibrationOptions& o) {
  visit("scale_sigma",
        o.scale_sigma,
        {.help = "relative sigma of the distance travelled", .min = 0, .max = 0.1});
  visit("balance_sigma",
        o.balance_sigma,
        {.help = "relative sigma of right wheels against left ones", .min = 0, .max = 0.1});
  visit("turn_sigma",
        o.turn_sigma,
        {.help = "relative sigma of the angle turned", .min = 0, .max = 0.1});
}

struct OdometryOptions {
  int ticks_per_turn = 2000;  ///< Encoder ticks per turn of a wheel.
  /// Sigma of the distance that a wheel's turning is read as, after one metre; it grows with the
  /// root of the distance.
  double travel_noise_m = 0.002;
  /// How much too large the left wheels are thought to be; relative.
  double left_radius_error = 0.0;
  double right_radius_error = 0.0;
  double turn_factor_error = 0.0;  ///< Relative error of the calibrated effective track.
  /// Calibration errors in addition to the three above, drawn at random.
  CalibrationOptions calibration;
};

template <class Visitor>
void Describe(Visitor& visit, OdometryOptions& o) {
  visit("ticks_per_turn",
        o.ticks_per_turn,
        {.help = "encoder steps in one turn of a wheel", .min = 4, .max = 10000000});
  visit("travel_noise_m",
        o.travel_noise_m,
        {.help = "sigma of the distance read after one metre", .min = 0, .max = 1});
  visit("left_radius_error",
        o.left_radius_error,
        {.help = "how much too large the left wheels are thought to be", .min = -0.5, .max = 0.5});
  visit("right_radius_error",
        o.right_radius_error,
        {.help = "how much too large the right wheels are thought to be", .min = -0.5, .max = 0.5});
  visit("turn_factor_error",
        o.turn_factor_error,
        {.help = "relative error of the calibrated effective track", .min = -0.5, .max = 0.5});
  visit("calibration", o.calibration, {.help = "errors that each robot draws for itself"});
}

/// Dead reckoning from the turning of the wheels, calibrated on firm floor. It sees the rims, not
/// the ground: slip is an error it cannot know of.
class WheelOdometry {
 public:
  WheelOdometry(const OdometryOptions& options, const WheelDriveOptions& drive, std::uint64_t seed);

  void Advance(const RimSpeeds& rims, std::chrono::duration<double> duration);

  /// Where the wheels say the robot is, seen from where it started.
  const qwsm::Pose2& T_odom_robot() const { return T_odom_robot_; }

 private:
  /// A side's encoder: turning that does not fill a step yet is kept for the next reading.
  struct Encoder {
    double turned_m = 0.0;
    double read_m = 0.0;
  };

  /// The distance that the encoder newly reports.
  double Read(Encoder& encoder, double rim_mps, std::chrono::duration<double> duration);

  double travel_noise_m_;
  double tick_m_;
  double left_scale_ = 1.0;  ///< Factor of a distance as read over the one rolled.
  double right_scale_ = 1.0;
  double effective_track_m_;
  Encoder left_;
  Encoder right_;
  RandomEngine random_;
  std::normal_distribution<double> standard_normal_;
  qwsm::Pose2 T_odom_robot_;
};

}  // namespace sim
