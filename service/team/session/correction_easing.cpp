// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/correction_easing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "qwsm/geometry/angle.hpp"

namespace qwsm::team {
namespace {

// A robot stands that has been within this of one place for so long. Matched poses of one that
// does differ by millimetres.
constexpr std::chrono::seconds kRest{1};
constexpr double kRest_m = 0.02;
constexpr double kRest_rad = 0.02;

/// How far apart two poses are, in metres, or radians where these are more.
double Distance(const Pose2& T_a_b) {
  return std::max(T_a_b.translation_m().norm(), std::abs(T_a_b.theta_rad));
}

}  // namespace

void CorrectionEasing::Correct(const Pose2& T_map_robot_before, const Pose2& T_map_robot) {
  if (options_.policy == CorrectionPolicy::kNow) return;
  const Pose2 T_before_map = T_map_robot_before * T_map_robot.Inverse();
  T_told_map_ = T_told_map_.value_or(Pose2{}) * T_before_map;
  if (stay_ && !stay_->is_by_odometry) stay_.reset();
}

std::optional<UncertainPose2> CorrectionEasing::Tell(const MappingStep& step,
                                                     const std::optional<Pose2>& T_odom_robot) {
  if (options_.policy == CorrectionPolicy::kNow) return std::nullopt;
  const bool stands = Stands(step, T_odom_robot);
  if (T_told_map_ && options_.policy == CorrectionPolicy::kSlew) Slew(step);
  if (stands && options_.policy == CorrectionPolicy::kRest) T_told_map_.reset();
  told_ = step.stamp;
  if (!T_told_map_) return std::nullopt;
  return UncertainPose2{.T_a_b = *T_told_map_} * step.map_robot;
}

// Odometry tells motion better than matching, which sees a millimetre where there is none.
bool CorrectionEasing::Stands(const MappingStep& step, const std::optional<Pose2>& T_odom_robot) {
  const Stay here{.since = step.stamp,
                  .is_by_odometry = T_odom_robot.has_value(),
                  .T_frame_robot = T_odom_robot.value_or(step.map_robot.T_a_b)};
  if (stay_ && stay_->is_by_odometry == here.is_by_odometry) {
    const Pose2 moved = stay_->T_frame_robot.Inverse() * here.T_frame_robot;
    const bool is_there =
        moved.translation_m().norm() < kRest_m && std::abs(moved.theta_rad) < kRest_rad;
    // A clock that was set back, by more than scans overtake each other, tells nothing.
    const Timestamp stayed = here.since - stay_->since;
    if (is_there && stayed > -kRest) return stayed >= kRest;
  }
  stay_ = here;
  return false;
}

// What is left of the correction shrinks evenly, as it is seen from where the robot is.
void CorrectionEasing::Slew(const MappingStep& step) {
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  const Pose2 T_told_robot = *T_told_map_ * T_map_robot;
  const Pose2 left{.x_m = T_told_robot.x_m - T_map_robot.x_m,
                   .y_m = T_told_robot.y_m - T_map_robot.y_m,
                   .theta_rad = NormalizeAngle(T_told_robot.theta_rad - T_map_robot.theta_rad)};
  const std::chrono::duration<double> passed = step.stamp - told_.value_or(step.stamp);
  const double step_by = options_.slew_mps * std::max(passed.count(), 0.0);
  const double distance = Distance(left);
  if (step_by >= distance) return T_told_map_.reset();
  const double share = 1.0 - step_by / distance;
  const Pose2 told{.x_m = T_map_robot.x_m + share * left.x_m,
                   .y_m = T_map_robot.y_m + share * left.y_m,
                   .theta_rad = NormalizeAngle(T_map_robot.theta_rad + share * left.theta_rad)};
  T_told_map_ = told * T_map_robot.Inverse();
}

}  // namespace qwsm::team
