// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tie_graph.hpp"

#include <Eigen/LU>

#include "qwsm/geometry/along_axes.hpp"

namespace qwsm {
namespace {

// Surfaces that one scan has drawn alone lie where it is.
constexpr double kAlone_m = 0.0001;
constexpr double kAlone_rad = 0.0001;

// The surfaces of each submap, which lie where its first scan is.
class SurfaceNodes {
 public:
  SurfaceNodes(const ScanChains& chains, PoseGraph& graph)
      : chains_(chains), begin_(static_cast<NodeId>(graph.T_map_node.size())) {
    const Eigen::Matrix3d alone = UncertainPose2::WithSigmas({}, kAlone_m, kAlone_rad).covariance;
    for (const RigidSubmap& submap : chains_.submaps()) {
      const NodeId first = submap.nodes.front();
      const Eigen::Matrix3d error =
          AlongAxesOf(chains_.T_chain_node()[first], submap.error_of_surfaces) + alone;
      graph.edges.push_back({.from = first,
                             .to = static_cast<NodeId>(graph.T_map_node.size()),
                             .T_from_to = {},
                             .information = error.inverse()});
      graph.T_map_node.push_back(graph.T_map_node[first]);
    }
  }

  // A node that was matched with a submap. @param information along the axes of the chain.
  PoseEdge Tie(std::size_t submap,
               NodeId node,
               const Pose2& T_chain_node,
               const Eigen::Matrix3d& information) const {
    const NodeId first = chains_.submaps()[submap].nodes.front();
    const Pose2& T_chain_first = chains_.T_chain_node()[first];
    return {.from = begin_ + static_cast<NodeId>(submap),
            .to = node,
            .T_from_to = T_chain_first.Inverse() * T_chain_node,
            .information = AlongAxesOf(T_chain_first, information)};
  }

 private:
  const ScanChains& chains_;
  NodeId begin_;
};

}  // namespace

PoseGraph TieGraph(const ScanChains& chains,
                   std::span<const Pose2> T_map_node,
                   std::span<const FoundLoop> loops) {
  PoseGraph graph{.T_map_node = {T_map_node.begin(), T_map_node.end()},
                  .edges = {chains.motions().begin(), chains.motions().end()}};
  const SurfaceNodes surfaces(chains, graph);
  const std::span<const Pose2> T_chain_node = chains.T_chain_node();
  for (const SurfaceMatch& match : chains.matches()) {
    graph.edges.push_back(
        surfaces.Tie(match.submap, match.node, T_chain_node[match.node], match.information));
  }
  for (const FoundLoop& found : loops) {
    if (found.loop.verdict != LoopVerdict::kAccepted) continue;
    const PoseEdge& edge = found.loop.edge;
    graph.edges.push_back(surfaces.Tie(
        found.submap, edge.to, T_chain_node[edge.from] * edge.T_from_to, found.of_match));
  }
  return graph;
}

}  // namespace qwsm
