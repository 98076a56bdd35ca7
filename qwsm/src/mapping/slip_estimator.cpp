// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/slip_estimator.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "qwsm/sensor/deskew.hpp"

namespace qwsm {
namespace {

constexpr double kWalk_mps = 0.02;      // Sigma of the slip's change in a second.
constexpr double kWalk_rad_s = 0.005;   // The same of how it turns the robot.
constexpr double kSteadyFor_s = 2.0;    // Over which the slip stays about the same.
constexpr double kMostSigmasOff = 3.0;  // One wrong match, or odometry that jumps, moves it so far.

double SecondsIn(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

// A pose as seen from another one, by its numbers.
Eigen::Vector3d Missed(const Pose2& found, const Pose2& told) {
  return {
      found.x_m - told.x_m, found.y_m - told.y_m, NormalizeAngle(found.theta_rad - told.theta_rad)};
}

}  // namespace

LaserScan SlipEstimator::Mended(LaserScan scan) const {
  if (scan.deskewed_sweep.count() <= 0) return scan;
  const Eigen::Vector3d slipped = SecondsIn(scan.deskewed_sweep) * slip_;
  return Deskewed(scan, {slipped.x(), slipped.y(), slipped.z()});
}

Observation SlipEstimator::Mended(Observation observation) const {
  observation.scan = Mended(std::move(observation.scan));
  return observation;
}

std::optional<SlipEstimator::Look> SlipEstimator::LookOf(const Observation& observation,
                                                         const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  if (!is_matched || !observation.T_odom_robot) return std::nullopt;
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  Eigen::Matrix3d R_robot_map = Eigen::Matrix3d::Identity();
  R_robot_map.topLeftCorner<2, 2>() = T_map_robot.Rotation().transpose();
  return Look{
      .stamp = observation.scan.stamp,
      .T_map_robot = T_map_robot,
      .T_odom_robot = *observation.T_odom_robot,
      .gyro_rad = observation.gyro_rad,
      .variances = (R_robot_map * step.local_covariance * R_robot_map.transpose()).diagonal()};
}

void SlipEstimator::Learn(const Observation& observation, const MappingStep& step) {
  if (observation.scan.deskewed_sweep.count() <= 0) return;
  if (step.closed_loop) Interrupt();
  const std::optional<Look> before = std::exchange(last_, LookOf(observation, step));
  if (!before || !last_) return;
  const double elapsed_s = SecondsIn(last_->stamp - before->stamp);
  if (elapsed_s > 0.0 && elapsed_s <= kSteadyFor_s) Learn(*before, *last_, elapsed_s);
}

void SlipEstimator::Learn(const Look& before, const Look& now, double elapsed_s) {
  Pose2 told = before.T_odom_robot.Inverse() * now.T_odom_robot;
  if (before.gyro_rad && now.gyro_rad) told.theta_rad = *now.gyro_rad - *before.gyro_rad;
  const Eigen::Vector3d slipped =
      Missed(before.T_map_robot.Inverse() * now.T_map_robot, told) / elapsed_s;
  const Eigen::Vector3d walk(kWalk_mps, kWalk_mps, kWalk_rad_s);
  for (int i = 0; i < 3; ++i) {
    variances_(i) += walk(i) * walk(i) * elapsed_s;
    const double noise = (before.variances(i) + now.variances(i)) / (elapsed_s * elapsed_s);
    const double most = kMostSigmasOff * std::sqrt(variances_(i) + noise);
    const double gain = variances_(i) / (variances_(i) + noise);
    slip_(i) += gain * std::clamp(slipped(i) - slip_(i), -most, most);
    variances_(i) *= 1.0 - gain;
  }
}

}  // namespace qwsm
