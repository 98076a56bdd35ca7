// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tie_graph.hpp"

#include <Eigen/LU>

namespace qwsm {
namespace {

// Surfaces that one scan has drawn alone lie where it is.
constexpr double kAlone_m = 0.0001;
constexpr double kAlone_rad = 0.0001;

// The surfaces of each submap, which lie where its first scan is.
class SurfaceNodes {
 public:
  SurfaceNodes(std::span<const RigidSubmap> submaps, PoseGraph& graph)
      : submaps_(submaps), begin_(static_cast<NodeId>(graph.T_map_node.size())) {
    const Eigen::Matrix3d alone = UncertainPose2::WithSigmas({}, kAlone_m, kAlone_rad).covariance;
    for (const RigidSubmap& submap : submaps_) {
      const NodeId first = submap.nodes.front();
      graph.edges.push_back({.from = first,
                             .to = static_cast<NodeId>(graph.T_map_node.size()),
                             .T_from_to = {},
                             .information = (submap.error_of_surfaces + alone).inverse()});
      graph.T_map_node.push_back(graph.T_map_node[first]);
    }
  }

  PoseEdge Tie(const SurfaceMatch& match) const {
    return {.from = NodeOf(match.submap),
            .to = match.node,
            .T_from_to = match.T_first_node,
            .information = match.information};
  }

  PoseEdge Tie(const FoundLoop& found, std::span<const Pose2> T_chain_node) const {
    const RigidSubmap& submap = submaps_[found.submap];
    const Pose2 T_reference_first =
        T_chain_node[submap.reference()].Inverse() * T_chain_node[submap.nodes.front()];
    return {.from = NodeOf(found.submap),
            .to = found.loop.edge.to,
            .T_from_to = T_reference_first.Inverse() * found.loop.edge.T_from_to,
            .information = AlongAxesOf(T_reference_first, found.of_match)};
  }

 private:
  NodeId NodeOf(std::size_t submap) const { return begin_ + static_cast<NodeId>(submap); }

  std::span<const RigidSubmap> submaps_;
  NodeId begin_;
};

}  // namespace

PoseGraph TieGraph(const ScanChains& chains,
                   std::span<const Pose2> T_map_node,
                   std::span<const FoundLoop> loops) {
  PoseGraph graph{.T_map_node = {T_map_node.begin(), T_map_node.end()},
                  .edges = {chains.motions().begin(), chains.motions().end()}};
  const SurfaceNodes surfaces(chains.submaps(), graph);
  for (const SurfaceMatch& match : chains.matches()) graph.edges.push_back(surfaces.Tie(match));
  for (const FoundLoop& found : loops) {
    if (found.loop.verdict != LoopVerdict::kAccepted) continue;
    graph.edges.push_back(surfaces.Tie(found, chains.T_chain_node()));
  }
  return graph;
}

}  // namespace qwsm
