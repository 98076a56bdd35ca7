// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "qwsm/correction/scan_node.hpp"
#include "qwsm/graph/pose_graph.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/matching/surface_map.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

/// A few scans in a row as one rigid body, in the frame of their chain.
struct RigidSubmap {
  NodeId first = 0;
  NodeId end = 0;  ///< Behind the last one.

  /// The scan in the middle, which stands for all.
  NodeId reference() const { return first + (end - first) / 2; }
};

/// Relevant scans in a row, each matched with those just before it, in a frame of their own that
/// no closed loop bends: the backbone of the pose graph.
class ScanChain {
 public:
  explicit ScanChain(const MapperOptions& options);

  void Add(const ScanNode& node);

  std::span<const Pose2> T_chain_node() const { return T_chain_node_; }
  /// Edges from each node to the next.
  std::span<const PoseEdge> edges() const { return edges_; }
  /// Submaps of the chain, which overlap by half.
  std::span<const RigidSubmap> submaps() const { return submaps_; }

  /// The surfaces that the scans of a submap show, in the frame of the chain. They are not kept:
  /// of a long drive they would be several times the map.
  /// @param nodes all that were added
  SurfaceMap SurfacesOf(const RigidSubmap& submap, std::span<const ScanNode> nodes) const;

  /// The pose of a node as seen from an earlier one, as uncertain as the edges between them tell.
  /// Complexity: linear in the nodes between.
  UncertainPose2 Relative(NodeId from, NodeId to) const;

 private:
  UncertainPose2 Attach(const ScanNode& node, std::span<const ScanPoint> points) const;
  void InsertIntoSubmaps(NodeId id, std::span<const ScanPoint> points);
  void Insert(NodeId id, std::span<const ScanPoint> points, SurfaceMap& surfaces) const;

  ScanMapOptions map_options_;
  ScanLocatorOptions locator_;
  WeightedScanMatcher matcher_;
  std::vector<Pose2> T_chain_node_;
  std::vector<PoseEdge> edges_;
  std::vector<RigidSubmap> submaps_;
  std::deque<SurfaceMap> last_surfaces_;  // Of the last two submaps, which still grow.
  Pose2 T_map_last_;                      // Of the last node, as it was answered.
};

}  // namespace qwsm
