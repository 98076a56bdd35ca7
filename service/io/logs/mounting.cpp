// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/mounting.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm::io {
namespace {

// Poses are written with two or more decimals.
constexpr double kSame_m = 0.02;
constexpr double kSame_rad = 0.02;
constexpr double kFarthest_m = 3.0;  // No robot carries its laser farther out.
constexpr double kAgreeingShare = 0.95;

template <class Component>
double Median(std::vector<Pose2> poses, Component component) {
  const auto middle = poses.begin() + static_cast<std::ptrdiff_t>(poses.size() / 2);
  std::nth_element(poses.begin(), middle, poses.end(), [&](const Pose2& a, const Pose2& b) {
    return component(a) < component(b);
  });
  return component(*middle);
}

/// To a tenth of a millimetre: a tape measure was used, the rest is rounding of the poses.
double RoundedM(double value_m) { return std::round(value_m * 1e4) / 1e4 + 0.0; }  // No -0.

bool IsNear(const Pose2& a, const Pose2& b) {
  return (a.translation_m() - b.translation_m()).norm() < kSame_m &&
         std::abs(NormalizeAngle(a.theta_rad - b.theta_rad)) < kSame_rad;
}

}  // namespace

void MountingEstimator::Add(const Pose2& T_odom_robot, const Pose2& T_odom_laser) {
  T_robot_laser_.push_back(T_odom_robot.Inverse() * T_odom_laser);
}

std::optional<Pose2> MountingEstimator::Estimate() const {
  if (T_robot_laser_.empty()) return std::nullopt;
  const double reference_rad = T_robot_laser_.front().theta_rad;  // Medians do not like the wrap.
  const double turn_rad = Median(T_robot_laser_, [&](const Pose2& pose) {
    return NormalizeAngle(pose.theta_rad - reference_rad);
  });
  const Pose2 median{RoundedM(Median(T_robot_laser_, [](const Pose2& pose) { return pose.x_m; })),
                     RoundedM(Median(T_robot_laser_, [](const Pose2& pose) { return pose.y_m; })),
                     NormalizeAngle(reference_rad + turn_rad)};
  const auto agreeing = std::ranges::count_if(
      T_robot_laser_, [&](const Pose2& pose) { return IsNear(pose, median); });
  const bool constant =
      static_cast<double>(agreeing) >= kAgreeingShare * static_cast<double>(T_robot_laser_.size());
  if (!constant || median.translation_m().norm() > kFarthest_m) return std::nullopt;
  return IsNear(median, Pose2{}) ? Pose2{} : median;
}

}  // namespace qwsm::io
