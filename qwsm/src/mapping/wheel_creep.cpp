// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/wheel_creep.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kWalk_per_sqrt_m = 0.002;  // Sigma of the share's change over a metre.
constexpr double kFarthest_sigmas = 3.0;    // One slip of the wheels is not to move it far.
constexpr double kMostShare = 0.5;          // Wheels that spin tell nothing of a way.

}  // namespace

Pose2 WheelCreep::TakenOut(const Pose2& told) const {
  return {(1.0 - share_) * told.x_m, (1.0 - share_) * told.y_m, told.theta_rad};
}

void WheelCreep::Learn(const UncertainPose2& before,
                       const UncertainPose2& motion,
                       const UncertainPose2& found) {
  const double way_m = motion.T_a_b.translation_m().norm();
  if (!(way_m > 0.0)) return;
  const UncertainPose2 expected = before * motion;
  const Eigen::Vector2d ahead = before.T_a_b.Rotation() * motion.T_a_b.translation_m() / way_m;
  const double behind_m = ahead.dot(expected.T_a_b.translation_m() - found.T_a_b.translation_m());
  const Eigen::Matrix2d noise = (expected.covariance + found.covariance).topLeftCorner<2, 2>();

  variance_ += kWalk_per_sqrt_m * kWalk_per_sqrt_m * way_m;
  const double told_m = way_m / (1.0 - share_);
  const double variance_m2 = told_m * told_m * variance_ + ahead.dot(noise * ahead);
  const double most_m = kFarthest_sigmas * std::sqrt(variance_m2);
  const double gain = told_m * variance_ / variance_m2;
  share_ += gain * std::clamp(behind_m, -most_m, most_m);
  share_ = std::clamp(share_, -kMostShare, kMostShare);
  variance_ *= 1.0 - gain * told_m;
}

}  // namespace qwsm
