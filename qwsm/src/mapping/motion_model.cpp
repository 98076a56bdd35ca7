// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/motion_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "qwsm/matching/match_result.hpp"

namespace qwsm {
namespace {

// A direction counts if the pairs tell at least this share of what they tell of the strongest one.
constexpr double kMinLearnedRatio = 0.25;
// Share of the newest innovation in a scale: it forgets with a time constant of twenty scans.
constexpr double kForgettingFactor = 0.05;
// The model counts as so many innovations: the first ones do not replace it.
constexpr double kPriorSamples = 4.0;
// One jump of the odometry, by more than three sigmas, is not to count for a hundred.
constexpr double kLargestChi2 = 9.0;
constexpr double kSurprisingChi2 = 25.0;  // Five sigmas.
constexpr double kSmallestShare = 1e-4;   // Of the variance at rest.
constexpr double kLargestScale = 25.0;

Eigen::Matrix3d Diagonal(const Eigen::Array33d& sigmas) {
  return sigmas.rowwise().sum().square().matrix().asDiagonal();
}

Pose2 ShareOf(const Pose2& motion, double share) {
  return {share * motion.x_m, share * motion.y_m, share * motion.theta_rad};
}

}  // namespace

Eigen::Array33d MotionModel::ModelledSigmas(const Pose2& motion, double share) const {
  // Of the same moment as the last scan, the next one still is not taken at quite the same place.
  const double at_rest = std::sqrt(std::max(share, kSmallestShare));
  const double way_m = motion.translation_m().norm();
  const double turn_rad = std::abs(motion.theta_rad);
  const Eigen::Array3d of_position(at_rest * noise_.translation_floor_m,
                                   noise_.translation_per_translation * way_m,
                                   noise_.translation_per_rotation_m * turn_rad);
  const Eigen::Array3d of_heading(at_rest * noise_.rotation_floor_rad,
                                  noise_.rotation_per_translation_rad * way_m,
                                  noise_.rotation_per_rotation * turn_rad);
  const Eigen::Array3d of_gyro(
      at_rest * noise_.gyro_floor_rad, 0.0, noise_.gyro_per_rotation * turn_rad);
  const Eigen::Array3d& heading = is_heading_by_gyro_ ? of_gyro : of_heading;
  Eigen::Array33d sigmas;
  sigmas << of_position.transpose(), of_position.transpose(), heading.transpose();
  return sigmas;
}

void MotionModel::SetHeadingByGyro(bool by_gyro) {
  if (by_gyro == std::exchange(is_heading_by_gyro_, by_gyro)) return;
  adapted_scale_.row(2).swap(other_scale_);
  samples_.row(2).swap(other_samples_);
}

PosePrediction MotionModel::Predict(const std::optional<Pose2>& T_odom_robot, double share) const {
  if (!T_odom_robot || !T_odom_last_) {
    const Pose2 motion = ShareOf(T_last_robot_, share);
    const UncertainPose2 as_before{
        .T_a_b = motion,
        .covariance = Diagonal(noise_.without_odometry * ModelledSigmas(motion, share))};
    return {.conservative = as_before, .adapted = as_before};
  }
  const Pose2 motion = T_odom_last_->Inverse() * *T_odom_robot;
  const Eigen::Array33d sigmas = ModelledSigmas(motion, share);
  return {.conservative = {.T_a_b = motion,
                           .covariance = Diagonal(sigmas * adapted_scale_.max(1.0).sqrt())},
          .adapted = AsProved(motion, share)};
}

UncertainPose2 MotionModel::AsProved(const Pose2& motion, double share) const {
  return {.T_a_b = motion,
          .covariance = Diagonal(ModelledSigmas(motion, share) * adapted_scale_.sqrt())};
}

void MotionModel::Adapt(const UncertainPose2& predicted,
                        const UncertainPose2& found,
                        const std::optional<Pose2>& T_odom_robot,
                        double share) {
  if (!T_odom_robot || !T_odom_last_) return;
  Adapt(predicted, found, T_odom_last_->Inverse() * *T_odom_robot, share);
}

void MotionModel::Adapt(const UncertainPose2& predicted,
                        const UncertainPose2& found,
                        const Pose2& motion,
                        double share) {
  const Eigen::Array33d sigmas = ModelledSigmas(motion, share) * adapted_scale_.sqrt();
  const Eigen::Matrix3d noise = Diagonal(sigmas);
  const Eigen::Array33d shares = sigmas.colwise() / sigmas.rowwise().sum();

  // Covariance of the innovation: the pose misses the prediction by the errors of both.
  const Eigen::Matrix3d expected = predicted.covariance + found.covariance;
  const double turn_rad = NormalizeAngle(found.T_a_b.theta_rad - predicted.T_a_b.theta_rad);
  UpdateScale(2, shares, turn_rad * turn_rad / expected(2, 2), noise(2, 2) / expected(2, 2));

  const Eigen::Matrix2d R_last_ref = (predicted.T_a_b * motion.Inverse()).Rotation().transpose();
  const Eigen::Vector2d innovation_m =
      found.T_a_b.translation_m() - predicted.T_a_b.translation_m();
  const Degeneracy degeneracy = DegeneracyOf(found.covariance.inverse());
  const Eigen::Vector2d& weakest = degeneracy.weakest_direction;
  const Eigen::Vector2d strongest(-weakest.y(), weakest.x());
  for (const Eigen::Vector2d& direction : {strongest, weakest}) {
    if (direction == weakest && degeneracy.ratio() < kMinLearnedRatio) continue;
    const Eigen::Vector2d in_last = R_last_ref * direction;
    const double expected_m2 = direction.dot(expected.topLeftCorner<2, 2>() * direction);
    const double noise_m2 = in_last.dot(noise.topLeftCorner<2, 2>() * in_last);
    const double innovation_chi2 = std::pow(direction.dot(innovation_m), 2) / expected_m2;
    for (const int axis : {0, 1}) {
      UpdateScale(
          axis, shares, innovation_chi2, std::pow(in_last(axis), 2) * noise_m2 / expected_m2);
    }
  }
}

// Scales each part of an axis' noise by its share in the innovation.
// @param innovation_chi2 squared innovation over its expected variance, the normalised innovation
//   squared: 1 on average where the noise is as modelled.
// @param weight share of the axis' noise in that variance.
void MotionModel::UpdateScale(int axis,
                              const Eigen::Array33d& shares,
                              double innovation_chi2,
                              double weight) {
  using Row = Eigen::Array<double, 1, 3>;
  const Row sample = weight * shares.row(axis);
  samples_.row(axis) += sample;
  const Row rate = (samples_.row(axis) + kPriorSamples).inverse().max(kForgettingFactor);
  adapted_scale_.row(axis) *= 1.0 + rate * sample * (std::min(innovation_chi2, kLargestChi2) - 1.0);
  adapted_scale_.row(axis) =
      adapted_scale_.row(axis).max(smallest_scale_).min(kLargestScale).eval();
}

bool MotionModel::IsSurprising(const std::optional<Pose2>& T_odom_robot, double share) const {
  if (!T_odom_robot || !T_odom_last_) return false;
  const Pose2 told = T_odom_last_->Inverse() * *T_odom_robot;
  const UncertainPose2 as_before = Predict(std::nullopt, share).conservative;
  const Eigen::Vector3d apart(told.x_m - as_before.T_a_b.x_m,
                              told.y_m - as_before.T_a_b.y_m,
                              NormalizeAngle(told.theta_rad - as_before.T_a_b.theta_rad));
  return (apart.array().square() / as_before.covariance.diagonal().array()).maxCoeff() >
         kSurprisingChi2;
}

void MotionModel::Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot) {
  T_last_robot_ = T_last_robot;
  T_odom_last_ = T_odom_robot;
}

}  // namespace qwsm
