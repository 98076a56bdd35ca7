// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "qwsm/correction/scan_node.hpp"
#include "qwsm/graph/graph_covariance.hpp"

namespace qwsm {

/// What is thought of the poses of all nodes.
class PoseEstimate {
 public:
  PoseEstimate() = default;
  PoseEstimate(const PoseEstimate&) = delete;
  PoseEstimate& operator=(const PoseEstimate&) = delete;
  virtual ~PoseEstimate() = default;

  virtual Pose2 T_map_node(NodeId node) const = 0;
  /// Of that pose, in the map.
  virtual const Eigen::Matrix3d& Covariance(NodeId node) const = 0;
  /// The poses of nodes as seen from an earlier one.
  virtual std::vector<UncertainPose2> SeenFrom(NodeId from,
                                               std::span<const NodeId> nodes) const = 0;
  /// Sigma of a node's position as seen from another one: it is no more than this, whatever their
  /// errors have in common.
  /// Complexity: constant.
  double SigmaXYAtMost_m(NodeId from, NodeId node) const;
};

/// The poses as they were answered. What a later one is more uncertain by than an earlier one is
/// how uncertain it is as seen from there.
class AnsweredPoses final : public PoseEstimate {
 public:
  /// @param nodes outlive this.
  explicit AnsweredPoses(std::span<const ScanNode> nodes) : nodes_(nodes) {}

  Pose2 T_map_node(NodeId node) const override { return nodes_[node].map_robot.T_a_b; }
  const Eigen::Matrix3d& Covariance(NodeId node) const override {
    return nodes_[node].map_robot.covariance;
  }
  std::vector<UncertainPose2> SeenFrom(NodeId from, std::span<const NodeId> nodes) const override;

 private:
  std::span<const ScanNode> nodes_;
};

/// The poses of a solved graph.
class SolvedPoses final : public PoseEstimate {
 public:
  SolvedPoses(const PoseGraph& graph, const GraphSolution& solution)
      : T_map_node_(solution.T_map_node),
        covariance_(graph, solution),
        marginals_(covariance_.Marginals()) {}

  Pose2 T_map_node(NodeId node) const override { return T_map_node_[node]; }
  const Eigen::Matrix3d& Covariance(NodeId node) const override { return marginals_[node]; }
  std::vector<UncertainPose2> SeenFrom(NodeId from, std::span<const NodeId> nodes) const override;
  /// The poses in the map; the first is certain.
  std::vector<UncertainPose2> map_node() const;

 private:
  std::vector<Pose2> T_map_node_;
  GraphCovariance covariance_;
  std::vector<Eigen::Matrix3d> marginals_;
};

}  // namespace qwsm
