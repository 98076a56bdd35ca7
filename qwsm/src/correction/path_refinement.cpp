// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "path_refinement.hpp"

#include <Eigen/LU>

#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {
namespace {

// Each takes every other turn. With more of them recorded logs are no better.
constexpr std::size_t kSweeps = 3;

// The edges of chains that meet at each node.
class EdgesByNode {
 public:
  EdgesByNode(std::span<const PoseEdge> edges, std::size_t nodes) : of_node_(nodes) {
    for (const PoseEdge& edge : edges) {
      of_node_[edge.from].push_back(&edge);
      of_node_[edge.to].push_back(&edge);
    }
  }

  // Where the nodes beside it have a node: the least squares of its edges, to first order.
  UncertainPose2 Predict(NodeId node, std::span<const Pose2> T_map_node) const {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    for (const PoseEdge* edge : of_node_[node]) {
      const EdgeLinearization linear = Linearize(*edge, T_map_node);
      const Eigen::Matrix3d& J = edge->from == node ? linear.J_from : linear.J_to;
      const Eigen::Matrix3d weighted = J.transpose() * edge->information;
      information += weighted * J;
      pull -= weighted * linear.error;
    }
    const Eigen::Matrix3d covariance = information.inverse();
    return {.T_a_b = Shifted(T_map_node[node], covariance * pull), .covariance = covariance};
  }

 private:
  std::vector<std::vector<const PoseEdge*>> of_node_;
};

// Turns are taken by halves, so that a scan never meets its own points.
bool IsInHalf(std::size_t half, NodeId node, const ScanChains& chains) {
  return chains.TurnOf(node) % 2 == half;
}

SurfaceMap SurfacesWithout(std::size_t half,
                           std::span<const ScanNode> nodes,
                           const ScanChains& chains,
                           std::span<const Pose2> T_map_node) {
  SurfaceMap surfaces = SurfaceMap::ForMatching(chains.map_options().surfaces);
  for (NodeId node = 0; node < nodes.size(); ++node) {
    if (IsInHalf(half, node, chains)) continue;
    const std::vector<ScanPoint> points = ToPoints(nodes[node].scan);
    const UncertainPose2 map_robot{.T_a_b = T_map_node[node]};
    for (const MapPoint& point : PointsToStore(surfaces, points, map_robot, chains.map_options())) {
      surfaces.Insert(point, node);
    }
  }
  return surfaces;
}

}  // namespace

std::vector<Pose2> RefinedPath(std::span<const ScanNode> nodes,
                               const ScanChains& chains,
                               const WeightedScanMatcher& matcher,
                               std::vector<Pose2> T_map_node) {
  const EdgesByNode chain_edges(chains.edges(), nodes.size());
  for (std::size_t sweep = 0; sweep < kSweeps; ++sweep) {
    const std::size_t half = sweep % 2;
    const SurfaceMap rest = SurfacesWithout(half, nodes, chains, T_map_node);
    for (NodeId node = 1; node < nodes.size(); ++node) {
      if (!IsInHalf(half, node, chains)) continue;
      const MatchPrior prior{.predicted = chain_edges.Predict(node, T_map_node),
                             .start = T_map_node[node],
                             .start_error = {.translation_m = 0.0}};
      const MatchResult match = matcher.Match(rest, ToPoints(nodes[node].scan), prior);
      T_map_node[node] = HasMatched(match) ? match.T_ref_cur : prior.predicted.T_a_b;
    }
  }
  return T_map_node;
}

}  // namespace qwsm
