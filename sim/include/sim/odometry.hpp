// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>

#include "qwsm/geometry/pose2.hpp"
#include "sim/random.hpp"
#include "sim/wheel_drive.hpp"

namespace sim {

struct OdometryOptions {
  int ticks_per_turn = 2000;  ///< Of a wheel.
  /// How unevenly a wheel's turning is read: sigma of the distance after one metre, growing with
  /// the root of the distance.
  double travel_noise_m = 0.002;
  double left_radius_error =
      0.0;  ///< How much too large the left wheels are thought to be; relative.
  double right_radius_error = 0.0;
  double turn_factor_error = 0.0;  ///< Relative error of the calibrated effective track.
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

  /// Distance the encoder newly reports.
  double Read(Encoder& encoder, double rim_mps, std::chrono::duration<double> duration);

  OdometryOptions options_;
  double tick_m_;
  double effective_track_m_;
  Encoder left_;
  Encoder right_;
  RandomEngine random_;
  std::normal_distribution<double> standard_normal_;
  qwsm::Pose2 T_odom_robot_;
};

}  // namespace sim
