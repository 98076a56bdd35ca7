// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "anchored_path.hpp"

#include <chrono>

#include "pose_estimate.hpp"

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

void AnchoredPath::Take(const MappingStep& step) {
  if (step.relevant) {
    anchors_.push_back(
        {.stamp = step.stamp, .map_robot = step.map_robot, .continues = !step.closed_loop});
  }
  answers_.push_back({.stamp = step.stamp, .map_robot = step.map_robot, .node = {}});
  if (!anchors_.empty()) answers_.back().node = static_cast<NodeId>(anchors_.size() - 1);
}

std::vector<UncertainPose2> AnchoredPath::AsAnswered() const {
  std::vector<UncertainPose2> path;
  path.reserve(answers_.size());
  for (const Answer& answer : answers_) path.push_back(answer.map_robot);
  return path;
}

std::vector<UncertainPose2> AnchoredPath::At(std::span<const UncertainPose2> map_node) const {
  std::vector<UncertainPose2> path;
  path.reserve(answers_.size());
  for (const Answer& answer : answers_) {
    path.push_back(answer.map_robot);
    if (!answer.node) continue;
    path.back() =
        map_node[*answer.node] * Since(anchors_[*answer.node].map_robot, answer.map_robot);
    path.back().T_a_b = Interpolated(answer, map_node);
  }
  return path;
}

Pose2 AnchoredPath::Interpolated(const Answer& answer,
                                 std::span<const UncertainPose2> map_node) const {
  const auto by = [&](NodeId node) {
    return map_node[node].T_a_b *
           (anchors_[node].map_robot.T_a_b.Inverse() * answer.map_robot.T_a_b);
  };
  const NodeId before = *answer.node;
  const NodeId after = before + 1;
  if (after == anchors_.size() || !anchors_[after].continues) return by(before);
  using Seconds = std::chrono::duration<double>;
  const Seconds since = answer.stamp - anchors_[before].stamp;
  const Seconds whole = anchors_[after].stamp - anchors_[before].stamp;
  return Between(by(before), by(after), whole.count() > 0.0 ? since / whole : 0.0);
}

}  // namespace qwsm
