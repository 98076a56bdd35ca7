// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "anchored_path.hpp"

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {
namespace {

// The part of the way from one pose to another that is near to it.
Pose2 Between(const Pose2& a, const Pose2& b, double share) {
  return {
      .x_m = a.x_m + share * (b.x_m - a.x_m),
      .y_m = a.y_m + share * (b.y_m - a.y_m),
      .theta_rad = NormalizeAngle(a.theta_rad + share * NormalizeAngle(b.theta_rad - a.theta_rad))};
}

}  // namespace

void AnchoredPath::Take(const MappingStep& step, const UncertainPose2& map_last) {
  const double strain = StrainOf(step, map_last);
  const double since_last = answers_.empty() ? 0.0 : answers_.back().strain;
  const bool is_node = step.relevant && step.map_relevant.T_a_b == step.map_robot.T_a_b;
  if (step.relevant) {
    anchors_.push_back({.T_last_this = {}, .strain = since_last + (is_node ? strain : 0.0)});
    if (anchors_.size() > 1 && !step.closed_loop) {
      anchors_.back().T_last_this = map_last.T_a_b.Inverse() * step.map_relevant.T_a_b;
    }
  }
  answers_.push_back({.node_robot = step.map_robot, .node = {}});
  if (anchors_.empty()) return;
  Answer& answer = answers_.back();
  answer.node = static_cast<NodeId>(anchors_.size() - 1);
  if (is_node) {
    answer.node_robot = {};
    return;
  }
  answer.node_robot = Since(step.relevant ? step.map_relevant : map_last, step.map_robot);
  answer.strain = strain + (step.relevant ? 0.0 : since_last);
}

// How much an answer is expected to have been off beside the one before: each as much as any other,
// and as many times more as it went elsewhere than odometry, in variances.
double AnchoredPath::StrainOf(const MappingStep& step, const UncertainPose2& map_last) const {
  if (answers_.empty() || step.odometry_motion.covariance.isZero()) return 1.0;
  const Pose2 T_map_before = map_last.T_a_b * answers_.back().node_robot.T_a_b;
  const UncertainPose2 answered{.T_a_b = T_map_before.Inverse() * step.map_robot.T_a_b};
  return 1.0 + SquaredMahalanobisDistance(step.odometry_motion, answered);
}

void AnchoredPath::ForgetSince(std::size_t first_answer, NodeId first_node) {
  answers_.erase(answers_.begin() + static_cast<std::ptrdiff_t>(first_answer), answers_.end());
  anchors_.erase(anchors_.begin() + first_node, anchors_.end());
}

std::vector<UncertainPose2> AnchoredPath::At(std::span<const UncertainPose2> map_node) const {
  std::vector<UncertainPose2> path;
  path.reserve(answers_.size());
  for (const Answer& answer : answers_) {
    path.push_back(answer.node_robot);
    if (!answer.node) continue;
    path.back() = map_node[*answer.node] * answer.node_robot;
    path.back().T_a_b = Interpolated(answer, map_node);
  }
  return path;
}

Pose2 AnchoredPath::Interpolated(const Answer& answer,
                                 std::span<const UncertainPose2> map_node) const {
  const NodeId before = *answer.node;
  const NodeId after = before + 1;
  const Pose2 by_before = map_node[before].T_a_b * answer.node_robot.T_a_b;
  const bool goes_on = after < anchors_.size() && anchors_[after].T_last_this;
  if (answer.strain == 0.0 || !goes_on) return by_before;
  const Pose2 T_before_map = *anchors_[after].T_last_this * map_node[after].T_a_b.Inverse();
  const Pose2 by_after = T_before_map.Inverse() * answer.node_robot.T_a_b;
  return Between(by_before, by_after, answer.strain / anchors_[after].strain);
}

}  // namespace qwsm
