// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/odometry_calibration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "qwsm/geometry/angle.hpp"
#include "qwsm/matching/match_result.hpp"

namespace qwsm {
namespace {

// Sigmas of the errors' changes: over a metre, over a radian turned, and over a metre.
const Eigen::Array3d kWalk(0.002, 0.002, 0.0005);
constexpr double kFarthest_sigmas = 3.0;  // One slip of the wheels is not to move them far.
constexpr double kMostShare = 0.5;        // Wheels that spin tell nothing of a way.
constexpr double kNoiseOfTurn_sigmas = 3.0;
// Along a corridor all that tells of the way may be somebody who walks in it.
constexpr double kLeastToldRatio = 0.4;

// The way, backwards less than zero.
double WayAhead_m(const Pose2& motion) {
  return std::copysign(motion.translation_m().norm(), motion.x_m);
}

// What a turn tells of the wheels: what is left of it beside its noise (the nonnegative garrote of
// Breiman 1995). Of a robot that drives straight on, odometry tells turns that are nothing else,
// and by them it would seem to turn less than it is told to.
double BesideNoise(double turn_rad, double variance_rad2) {
  const double turn_rad2 = turn_rad * turn_rad;
  const double noise_rad2 = kNoiseOfTurn_sigmas * kNoiseOfTurn_sigmas * variance_rad2;
  return turn_rad2 > noise_rad2 ? (1.0 - noise_rad2 / turn_rad2) * turn_rad : 0.0;
}

}  // namespace

Pose2 OdometryCalibration::Corrected(const Pose2& told) const {
  const double share = 1.0 - way_error();
  const Pose2 shorter{share * told.x_m, share * told.y_m, told.theta_rad};
  if (is_turn_by_gyro_) return shorter;
  return WithTurn(shorter,
                  (1.0 - turn_error()) * told.theta_rad - drift_rad_per_m() * WayAhead_m(told));
}

std::optional<Pose2> OdometryCalibration::Follow(const std::optional<Pose2>& T_odom_robot,
                                                 bool is_turn_by_gyro) {
  is_turn_by_gyro_ = is_turn_by_gyro;
  const std::optional<Pose2> T_before = std::exchange(T_odom_last_, T_odom_robot);
  told_ = {};
  if (!T_odom_robot) return std::nullopt;
  if (T_before) told_ = T_before->Inverse() * *T_odom_robot;
  T_corrected_ = T_before ? T_corrected_ * Corrected(told_) : *T_odom_robot;
  return T_corrected_;
}

void OdometryCalibration::Learn(const UncertainPose2& before,
                                const UncertainPose2& motion,
                                const UncertainPose2& found) {
  const UncertainPose2 expected = before * motion;
  const Eigen::Matrix3d noise = expected.covariance + found.covariance;
  const Eigen::Vector3d less = Difference(expected.T_a_b, found.T_a_b);
  const double ahead_m = WayAhead_m(told_);
  const double turn_rad = told_.theta_rad;
  covariance_.diagonal().array() +=
      kWalk.square() * Eigen::Array3d(std::abs(ahead_m), std::abs(turn_rad), std::abs(ahead_m));
  if (ahead_m != 0.0 && DegeneracyOf(found.covariance.inverse()).ratio() >= kLeastToldRatio) {
    const Eigen::Vector2d onwards =
        before.T_a_b.Rotation() * motion.T_a_b.translation_m().normalized();
    Update({std::abs(ahead_m), 0.0, 0.0},
           onwards.dot(less.head<2>()),
           onwards.dot(noise.topLeftCorner<2, 2>() * onwards));
  }
  if (!is_turn_by_gyro_) {
    Update({0.0, BesideNoise(turn_rad, noise(2, 2)), ahead_m}, less.z(), noise(2, 2));
  }
}

void OdometryCalibration::Update(const Eigen::Vector3d& told, double less, double variance) {
  const Eigen::Vector3d shared = covariance_ * told;
  const double expected_variance = told.dot(shared) + variance;
  if (!(expected_variance > 0.0) || !std::isfinite(expected_variance)) return;
  const double most = kFarthest_sigmas * std::sqrt(expected_variance);
  const Eigen::Vector3d gain = shared / expected_variance;
  errors_ += gain * std::clamp(less, -most, most);
  errors_ = errors_.cwiseMax(-kMostShare).cwiseMin(kMostShare);
  covariance_ -= gain * shared.transpose();
}

void OdometryCalibration::Restart(const std::optional<Pose2>& T_odom_robot) {
  T_odom_last_ = T_odom_robot;
  T_corrected_ = T_odom_robot.value_or(Pose2{});
  told_ = {};
}

}  // namespace qwsm
