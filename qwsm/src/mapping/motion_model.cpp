// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kForgetting = 0.05;     // Share of the newest motion in what was learned.
constexpr double kSquaredMiss = 4.0;     // What was found is fused with the prediction, and misses
                                         // it by about half as much as the truth.
constexpr double kLargestMisfit = 25.0;  // One jump of the odometry is not to count for a hundred.

}  // namespace

UncertainPose2 MotionModel::Predict(const std::optional<Pose2>& T_odom_robot) const {
  const bool has_odometry = T_odom_robot && T_odom_last_;
  const Pose2 motion = has_odometry ? T_odom_last_->Inverse() * *T_odom_robot : T_last_robot_;
  const double moved_m = motion.translation_m().norm();
  const double turned_rad = std::abs(motion.theta_rad);
  const double factor = has_odometry ? 1.0 : noise_.without_odometry;
  const double sigma_m =
      factor * (noise_.translation_floor_m + noise_.translation_per_translation * moved_m +
                noise_.translation_per_rotation_m * turned_rad);
  const double sigma_rad =
      factor * (noise_.rotation_floor_rad + noise_.rotation_per_rotation * turned_rad +
                noise_.rotation_per_translation_rad * moved_m);
  UncertainPose2 prediction{.T_a_b = motion};
  prediction.covariance.diagonal() << sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad;
  if (has_odometry) prediction.covariance *= Doubt();
  return prediction;
}

double MotionModel::Doubt() const { return std::max(1.0, misfit_); }

void MotionModel::Learn(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot) {
  if (!T_odom_robot || !T_odom_last_) return;
  const UncertainPose2 predicted = Predict(T_odom_robot);
  const Pose2 miss = predicted.T_a_b.Inverse() * T_last_robot;
  const Eigen::Array3d error(miss.x_m, miss.y_m, miss.theta_rad);
  const Eigen::Array3d variance = predicted.covariance.diagonal().array() / Doubt();
  const double squared = kSquaredMiss * (error.square() / variance).mean();
  misfit_ += kForgetting * (std::min(squared, kLargestMisfit) - misfit_);
}

void MotionModel::Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot) {
  T_last_robot_ = T_last_robot;
  T_odom_last_ = T_odom_robot;
}

}  // namespace qwsm
