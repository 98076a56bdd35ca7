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

constexpr double kSteadyFor_s = 2.0;    // Over which a velocity stays about the same.
constexpr double kMostSigmasOff = 3.0;  // One wrong match, or odometry that jumps, moves it so far.

// How far a velocity carries the robot, as the pose after it.
Pose2 MotionIn(std::chrono::nanoseconds time, const Eigen::Vector3d& velocity) {
  const Eigen::Vector3d moved = Seconds(time) * velocity;
  return {moved.x(), moved.y(), moved.z()};
}

}  // namespace

StillScan SlipEstimator::Mended(const Observation& observation) const {
  const LaserScan& scan = observation.scan;
  const bool could_be_still = scan.sweep.count() <= 0 || observation.T_odom_robot;
  if (scan.deskewed_sweep.count() <= 0 && could_be_still) return {.scan = scan};
  const Eigen::Vector3d velocity = UntoldOf(observation).mean;
  return {.scan = Deskewed(scan, MotionIn(SweepOf(scan), velocity)), .velocity = velocity};
}

// A scan fits the map as it was taken in the middle of its sweep, whatever its beams were moved by:
// the pose at the first beam follows by the velocity that was believed, which is not to confirm
// itself.
std::optional<SlipEstimator::Look> SlipEstimator::LookOf(const Observation& observation,
                                                         const Eigen::Vector3d& velocity,
                                                         const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  if (!is_matched) return std::nullopt;
  const Pose2 T_map_robot = step.map_robot.T_a_b;
  Eigen::Matrix3d R_robot_map = Eigen::Matrix3d::Identity();
  R_robot_map.topLeftCorner<2, 2>() = T_map_robot.Rotation().transpose();
  return Look{
      .stamp = observation.scan.stamp,
      .T_map_robot = T_map_robot * MotionIn(SweepOf(observation.scan) / 2, velocity),
      .T_odom_robot = observation.T_odom_robot,
      .gyro_rad = observation.gyro_rad,
      .variances = (R_robot_map * step.local_covariance * R_robot_map.transpose()).diagonal()};
}

void SlipEstimator::Learn(const Observation& observation,
                          const std::optional<Eigen::Vector3d>& velocity,
                          const MappingStep& step) {
  if (!velocity) return;
  if (step.closed_loop) Interrupt();
  const std::optional<Look> before = std::exchange(last_, LookOf(observation, *velocity, step));
  if (!before || !last_) return;
  const double elapsed_s = Seconds(last_->stamp - before->stamp);
  if (elapsed_s > 0.0 && elapsed_s <= kSteadyFor_s) Learn(*before, *last_, elapsed_s);
}

void SlipEstimator::Learn(const Look& before, const Look& now, double elapsed_s) {
  const Pose2 found = before.T_map_robot.Inverse() * now.T_map_robot;
  const Eigen::Vector3d noise = (before.variances + now.variances) / (elapsed_s * elapsed_s);
  velocity_.Learn(Difference(found, {}) / elapsed_s, noise, elapsed_s);
  if (!before.T_odom_robot || !now.T_odom_robot) return;
  Pose2 told = before.T_odom_robot->Inverse() * *now.T_odom_robot;
  if (before.gyro_rad && now.gyro_rad) told.theta_rad = *now.gyro_rad - *before.gyro_rad;
  slip_.Learn(Difference(found, told) / elapsed_s, noise, elapsed_s);
}

void SlipEstimator::Velocity::Learn(const Eigen::Vector3d& seen,
                                    const Eigen::Vector3d& noise,
                                    double elapsed_s) {
  for (int i = 0; i < 3; ++i) {
    variances(i) += walk(i) * walk(i) * elapsed_s;
    const double most = kMostSigmasOff * std::sqrt(variances(i) + noise(i));
    const double gain = variances(i) / (variances(i) + noise(i));
    mean(i) += gain * std::clamp(seen(i) - mean(i), -most, most);
    variances(i) *= 1.0 - gain;
  }
}

}  // namespace qwsm
