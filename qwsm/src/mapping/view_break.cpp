// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/view_break.hpp"

#include <cmath>
#include <utility>

namespace qwsm {
namespace {

// Between two scans that show nearly the same.
constexpr double kSameView_m = 0.25;
constexpr double kSameView_rad = 0.25;
// A wrong pose explains by chance about half of what the right one does: half way between them.
constexpr double kStillExplained = 0.75;

}  // namespace

bool ViewBreak::IsSameView(const Pose2& moved) {
  return moved.translation_m().norm() < kSameView_m && std::abs(moved.theta_rad) < kSameView_rad;
}

bool ViewBreak::IsAsBefore(double explained, double before) {
  return explained >= kStillExplained * before;
}

// Where a scan that fits nowhere is matched, its pose tells nothing of the motion: odometry does.
bool ViewBreak::Take(const MappingStep& step) {
  const bool is_matched =
      step.status == StepStatus::kMatched || step.status == StepStatus::kExtended;
  const double explained = is_matched ? step.match.overlap : 0.0;
  const double before = std::exchange(explained_, explained);
  const std::optional<Pose2> T_map_last = std::exchange(T_map_last_, step.map_robot.T_a_b);
  if (!T_map_last || step.closed_loop || !IsSameView(step.odometry_motion.T_a_b)) return false;
  const bool is_elsewhere = !IsSameView(T_map_last->Inverse() * step.map_robot.T_a_b);
  return is_elsewhere || !IsAsBefore(explained, before);
}

}  // namespace qwsm
