// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/gyro_odometry.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kBiasWalk_rad_s = 1e-5;        // Sigma of the bias's change in a second.
constexpr double kNoise_rad_per_sqrt_s = 2e-3;  // Of an angle after a second: that of a cheap one.
constexpr double kLongestGap_s = 2.0;           // Over which a gyro's angle is believed.
constexpr double kForgetting = 0.02;            // Share of the last error in the mean squares.
constexpr double kBenefitOfDoubt = 2.0;         // A gyro does not slip.
constexpr int kLeastTurns = 10;                 // Before it is known which of both is better.
constexpr double kMostSigmas = 3.0;             // One wrong match is not to move the bias far.

}  // namespace

std::optional<GyroOdometry::Turn> GyroOdometry::TurnSince(const Observation& observation) const {
  if (!observation.gyro_rad || !gyro_last_rad_ || !T_wheels_last_) return std::nullopt;
  const double duration_s = Seconds(observation.scan.stamp - stamp_last_);
  if (!(duration_s >= 0.0 && duration_s <= kLongestGap_s)) return std::nullopt;
  return Turn{.by_wheels_rad =
                  NormalizeAngle(observation.T_odom_robot->theta_rad - T_wheels_last_->theta_rad),
              .by_gyro_rad = *observation.gyro_rad - *gyro_last_rad_ - bias_rad_s_ * duration_s,
              .duration_s = duration_s};
}

// What is left of the bias turns every motion the same way, and is to be lost in the gyro's noise.
bool GyroOdometry::IsBiasKnown(double duration_s) const {
  return bias_variance_ * duration_s <= kNoise_rad_per_sqrt_s * kNoise_rad_per_sqrt_s;
}

std::optional<Pose2> GyroOdometry::Follow(const Observation& observation) {
  turn_.reset();
  leads_ = false;
  if (observation.T_odom_robot) {
    turn_ = TurnSince(observation);
    leads_ = turn_ && IsBiasKnown(turn_->duration_s) && learned_ >= kLeastTurns &&
             gyro_chi2_ <= kBenefitOfDoubt * wheels_chi2_;
    const bool is_apart = leads_ || (T_wheels_last_ && T_odom_robot_ != *T_wheels_last_);
    if (is_apart) {
      const Pose2 motion = T_wheels_last_->Inverse() * *observation.T_odom_robot;
      T_odom_robot_ = T_odom_robot_ * (leads_ ? WithTurn(motion, turn_->by_gyro_rad) : motion);
    } else {
      T_odom_robot_ = *observation.T_odom_robot;
    }
  }
  T_wheels_last_ = observation.T_odom_robot;
  gyro_last_rad_ = observation.gyro_rad;
  stamp_last_ = observation.scan.stamp;
  return observation.T_odom_robot ? std::optional(T_odom_robot_) : std::nullopt;
}

void GyroOdometry::Learn(double turn_rad, double sigma_rad) {
  if (!turn_) return;
  const double of_wheels_rad = NormalizeAngle(turn_rad - turn_->by_wheels_rad);
  const double of_gyro_rad = NormalizeAngle(turn_rad - turn_->by_gyro_rad);
  const double duration_s = turn_->duration_s;
  bias_variance_ += kBiasWalk_rad_s * kBiasWalk_rad_s * duration_s;
  const double variance = duration_s * duration_s * bias_variance_ +
                          kNoise_rad_per_sqrt_s * kNoise_rad_per_sqrt_s * duration_s +
                          sigma_rad * sigma_rad;
  if (!(variance > 0.0)) return;
  ++learned_;
  wheels_chi2_ += kForgetting * (of_wheels_rad * of_wheels_rad / variance - wheels_chi2_);
  gyro_chi2_ += kForgetting * (of_gyro_rad * of_gyro_rad / variance - gyro_chi2_);
  const double most_rad = kMostSigmas * std::sqrt(variance);
  const double gain = bias_variance_ * duration_s / variance;
  bias_rad_s_ -= gain * std::clamp(of_gyro_rad, -most_rad, most_rad);
  bias_variance_ *= 1.0 - gain * duration_s;
}

void GyroOdometry::Restart(const std::optional<Pose2>& T_odom_robot) {
  T_wheels_last_ = T_odom_robot;
  T_odom_robot_ = T_odom_robot.value_or(Pose2{});
  gyro_last_rad_.reset();
}

}  // namespace qwsm
