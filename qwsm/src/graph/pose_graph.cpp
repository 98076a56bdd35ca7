// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/graph/pose_graph.hpp"

namespace qwsm {

UncertainPose2 MeasuredBy(const PoseEdge& edge) {
  constexpr double kLeastInformation = 1e-6;
  return {
      .T_a_b = edge.T_from_to,
      .covariance = (edge.information + kLeastInformation * Eigen::Matrix3d::Identity()).inverse()};
}

EdgeLinearization Linearize(const PoseEdge& edge, std::span<const Pose2> T_map_node) {
  const Pose2& from = T_map_node[edge.from];
  const Pose2& to = T_map_node[edge.to];
  const Eigen::Matrix2d R_from_map = from.Rotation().transpose();
  const Eigen::Vector2d t_from_to = R_from_map * (to.translation_m() - from.translation_m());

  EdgeLinearization linear;
  linear.error << t_from_to - edge.T_from_to.translation_m(),
      NormalizeAngle(to.theta_rad - from.theta_rad - edge.T_from_to.theta_rad);
  linear.J_from << -R_from_map, Eigen::Vector2d(t_from_to.y(), -t_from_to.x()),
      Eigen::RowVector3d(0.0, 0.0, -1.0);
  linear.J_to << R_from_map, Eigen::Vector2d::Zero(), Eigen::RowVector3d(0.0, 0.0, 1.0);
  return linear;
}

double Chi2(const PoseEdge& edge, std::span<const Pose2> T_map_node) {
  const Eigen::Vector3d error = Linearize(edge, T_map_node).error;
  return error.dot(edge.information * error);
}

}  // namespace qwsm
