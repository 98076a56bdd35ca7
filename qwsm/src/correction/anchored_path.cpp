// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/anchored_path.hpp"

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {

void AnchoredPath::Take(const MappingStep& step, const std::optional<UncertainPose2>& map_last) {
  const double strain = StrainOf(step, map_last);
  const double since_last = answers_.empty() ? 0.0 : answers_.back().strain;
  const bool is_node = step.relevant && !step.relevant_is_before;
  if (step.relevant) {
    anchors_.push_back({.T_last_this = {}, .strain = since_last + (is_node ? strain : 0.0)});
    if (map_last && !step.closed_loop) {
      anchors_.back().T_last_this = map_last->T_a_b.Inverse() * step.map_relevant.T_a_b;
    }
  }
  answers_.push_back({.node_robot = step.map_robot, .node = {}});
  if (anchors_.empty() || (!step.relevant && !map_last)) return;
  Answer& answer = answers_.back();
  answer.node = static_cast<NodeId>(anchors_.size() - 1);
  if (is_node) {
    answer.node_robot = {};
    return;
  }
  answer.node_robot = Since(step.relevant ? step.map_relevant : *map_last, step.map_robot);
  answer.strain = strain + (step.relevant ? 0.0 : since_last);
}

// How much an answer is expected to have been off beside the one before: each as much as any other,
// and as many times more as it went elsewhere than odometry, in variances.
double AnchoredPath::StrainOf(const MappingStep& step,
                              const std::optional<UncertainPose2>& map_last) const {
  if (answers_.empty() || !map_last || step.odometry_motion.covariance.isZero()) return 1.0;
  const Pose2 T_map_before = map_last->T_a_b * answers_.back().node_robot.T_a_b;
  const UncertainPose2 answered{.T_a_b = T_map_before.Inverse() * step.map_robot.T_a_b};
  return 1.0 + SquaredMahalanobisDistance(step.odometry_motion, answered);
}

void AnchoredPath::ForgetSince(std::size_t first_answer, NodeId first_node) {
  answers_.erase(answers_.begin() + static_cast<std::ptrdiff_t>(first_answer), answers_.end());
  anchors_.erase(anchors_.begin() + first_node, anchors_.end());
}

std::vector<UncertainPose2> AnchoredPath::At(std::span<const UncertainPose2> map_node) const {
  const std::vector<std::optional<UncertainPose2>> all(map_node.begin(), map_node.end());
  std::vector<UncertainPose2> path;
  path.reserve(answers_.size());
  for (const Answer& answer : answers_) {
    path.push_back(Place(answer, all).value_or(answer.node_robot));
  }
  return path;
}

std::vector<std::optional<UncertainPose2>> AnchoredPath::At(
    std::span<const std::optional<UncertainPose2>> map_node) const {
  std::vector<std::optional<UncertainPose2>> path;
  path.reserve(answers_.size());
  for (const Answer& answer : answers_) path.push_back(Place(answer, map_node));
  return path;
}

std::optional<UncertainPose2> AnchoredPath::Place(
    const Answer& answer, std::span<const std::optional<UncertainPose2>> map_node) const {
  if (!answer.node || !map_node[*answer.node]) return std::nullopt;
  const UncertainPose2& before = *map_node[*answer.node];
  UncertainPose2 placed = before * answer.node_robot;
  const NodeId next = *answer.node + 1;
  const bool goes_on =
      next < anchors_.size() && anchors_[next].T_last_this && map_node[next].has_value();
  if (answer.strain == 0.0 || !goes_on) return placed;
  const Pose2 T_before_map = *anchors_[next].T_last_this * map_node[next]->T_a_b.Inverse();
  const Pose2 by_next = T_before_map.Inverse() * answer.node_robot.T_a_b;
  const double share = answer.strain / anchors_[next].strain;
  placed.T_a_b = Between(before.T_a_b * answer.node_robot.T_a_b, by_next, share);
  return placed;
}

}  // namespace qwsm
