// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_estimate.hpp"

#include <cmath>

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {

namespace {

// A pose as seen from another one, where the errors of both have nothing in common.
UncertainPose2 Beside(const UncertainPose2& map_other, const UncertainPose2& map_robot) {
  UncertainPose2 apart = map_robot;
  apart.covariance += FrameCovariance::Of(map_other).At(apart.T_a_b.translation_m());
  return UncertainPose2{.T_a_b = map_other.T_a_b.Inverse()} * apart;
}

double SigmaXY_m(const Eigen::Matrix3d& covariance) {
  return UncertainPose2{.T_a_b = {}, .covariance = covariance}.SigmaXY_m();
}

}  // namespace

// The heading it is seen with turns it about that pose; by Minkowski, sigmas of what is added up
// are never more than their sum.
double PoseEstimate::SigmaXYAtMost_m(NodeId from, NodeId node) const {
  const Eigen::Vector2d apart_m =
      T_map_node(node).translation_m() - T_map_node(from).translation_m();
  const Eigen::Matrix3d& of_from = Covariance(from);
  const double of_heading_m = apart_m.norm() * std::sqrt(0.5 * of_from(2, 2));
  return SigmaXY_m(Covariance(node)) + SigmaXY_m(of_from) + of_heading_m;
}

std::vector<UncertainPose2> AnsweredPoses::SeenFrom(NodeId from,
                                                    std::span<const NodeId> nodes) const {
  std::vector<UncertainPose2> seen;
  seen.reserve(nodes.size());
  for (const NodeId node : nodes) {
    const bool is_of_one_robot = nodes_[from].robot == nodes_[node].robot;
    seen.push_back(
        (is_of_one_robot ? Since : Beside)(nodes_[from].map_robot, nodes_[node].map_robot));
  }
  return seen;
}

std::vector<UncertainPose2> SolvedPoses::map_node() const {
  std::vector<UncertainPose2> map_node;
  map_node.reserve(T_map_node_.size());
  for (NodeId node = 0; node < T_map_node_.size(); ++node) {
    map_node.push_back({.T_a_b = T_map_node_[node], .covariance = marginals_[node]});
  }
  return map_node;
}

std::vector<UncertainPose2> SolvedPoses::SeenFrom(NodeId from,
                                                  std::span<const NodeId> nodes) const {
  const auto covariances = covariance_.RelativeTo(from, nodes, marginals_);
  const Pose2 T_from_map = T_map_node_[from].Inverse();
  std::vector<UncertainPose2> seen;
  seen.reserve(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    seen.push_back({.T_a_b = T_from_map * T_map_node_[nodes[i]], .covariance = covariances[i]});
  }
  return seen;
}

}  // namespace qwsm
