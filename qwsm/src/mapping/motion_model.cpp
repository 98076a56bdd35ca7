// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/motion_model.hpp"

#include <cmath>

namespace qwsm {

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
  return prediction;
}

void MotionModel::Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot) {
  T_last_robot_ = T_last_robot;
  T_odom_last_ = T_odom_robot;
}

}  // namespace qwsm
