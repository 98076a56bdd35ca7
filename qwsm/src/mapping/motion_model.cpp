// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/motion_model.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kWellHeld = 0.25;    // Share of the best held direction's information.
constexpr double kForgetting = 0.05;  // Share of the newest lesson in what was learned;
constexpr double kFirstLessons =
    4.0;  // the first ones count for more, as in a mean with this many.
constexpr double kLargestMisfit = 9.0;   // One jump of the odometry is not to count for a hundred.
constexpr double kSmallestScale = 0.02;  // Odometry is never believed to the last.
constexpr double kLargestScale = 25.0;

Eigen::Matrix3d Diagonal(const Eigen::Array33d& sigmas) {
  return sigmas.rowwise().sum().square().matrix().asDiagonal();
}

}  // namespace

Eigen::Array33d MotionModel::ModelledSigmas(const Pose2& motion) const {
  const double way_m = motion.translation_m().norm();
  const double turn_rad = std::abs(motion.theta_rad);
  const Eigen::Array3d of_position(noise_.translation_floor_m,
                                   noise_.translation_per_translation * way_m,
                                   noise_.translation_per_rotation_m * turn_rad);
  const Eigen::Array3d of_heading(noise_.rotation_floor_rad,
                                  noise_.rotation_per_translation_rad * way_m,
                                  noise_.rotation_per_rotation * turn_rad);
  Eigen::Array33d sigmas;
  sigmas << of_position.transpose(), of_position.transpose(), of_heading.transpose();
  return sigmas;
}

PosePrediction MotionModel::Predict(const std::optional<Pose2>& T_odom_robot) const {
  if (!T_odom_robot || !T_odom_last_) {
    const UncertainPose2 as_before{
        .T_a_b = T_last_robot_,
        .covariance = Diagonal(noise_.without_odometry * ModelledSigmas(T_last_robot_))};
    return {.cautious = as_before, .learned = as_before};
  }
  const Pose2 motion = T_odom_last_->Inverse() * *T_odom_robot;
  const Eigen::Array33d sigmas = ModelledSigmas(motion);
  return {.cautious = {.T_a_b = motion,
                       .covariance = Diagonal(sigmas * learned_scale_.max(1.0).sqrt())},
          .learned = {.T_a_b = motion, .covariance = Diagonal(sigmas * learned_scale_.sqrt())}};
}

void MotionModel::Learn(const UncertainPose2& predicted,
                        const MatchResult& found,
                        const std::optional<Pose2>& T_odom_robot) {
  if (!T_odom_robot || !T_odom_last_) return;
  const Pose2 motion = T_odom_last_->Inverse() * *T_odom_robot;
  const Eigen::Array33d sigmas = ModelledSigmas(motion) * learned_scale_.sqrt();
  const Eigen::Matrix3d noise = Diagonal(sigmas);
  const Eigen::Array33d shares = sigmas.colwise() / sigmas.rowwise().sum();

  // Found without regard to the prediction, the pose misses it by the errors of both.
  const Eigen::Matrix3d expected = predicted.covariance + found.covariance;
  const double turn_rad = NormalizeAngle(found.T_ref_cur.theta_rad - predicted.T_a_b.theta_rad);
  Teach(2, shares, turn_rad * turn_rad / expected(2, 2), noise(2, 2) / expected(2, 2));

  const Eigen::Matrix2d R_last_ref = (predicted.T_a_b * motion.Inverse()).Rotation().transpose();
  const Eigen::Vector2d way_m = found.T_ref_cur.translation_m() - predicted.T_a_b.translation_m();
  const PositionHold hold = HoldOf(found.information);
  const Eigen::Vector2d strongest(-hold.weakest.y(), hold.weakest.x());
  for (const Eigen::Vector2d& direction : {strongest, hold.weakest}) {
    if (direction == hold.weakest && hold.share() < kWellHeld) continue;
    const Eigen::Vector2d in_last = R_last_ref * direction;
    const double expected_m2 = direction.dot(expected.topLeftCorner<2, 2>() * direction);
    const double noise_m2 = in_last.dot(noise.topLeftCorner<2, 2>() * in_last);
    const double misfit = std::pow(direction.dot(way_m), 2) / expected_m2;
    for (const int axis : {0, 1}) {
      Teach(axis, shares, misfit, std::pow(in_last(axis), 2) * noise_m2 / expected_m2);
    }
  }
}

// Each part of an axis' noise learns by its share of it.
void MotionModel::Teach(int axis, const Eigen::Array33d& shares, double misfit, double weight) {
  using Row = Eigen::Array<double, 1, 3>;
  const Row lesson = weight * shares.row(axis);
  lessons_.row(axis) += lesson;
  const Row rate = (lessons_.row(axis) + kFirstLessons).inverse().max(kForgetting);
  learned_scale_.row(axis) *= 1.0 + rate * lesson * (std::min(misfit, kLargestMisfit) - 1.0);
  learned_scale_.row(axis) = learned_scale_.row(axis).max(kSmallestScale).min(kLargestScale).eval();
}

void MotionModel::Remember(const Pose2& T_last_robot, const std::optional<Pose2>& T_odom_robot) {
  T_last_robot_ = T_last_robot;
  T_odom_last_ = T_odom_robot;
}

}  // namespace qwsm
