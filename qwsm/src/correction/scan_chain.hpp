// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  SurfaceMap surfaces;

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
  /// From each node to the next.
  std::span<const PoseEdge> edges() const { return edges_; }
  /// They overlap by half.
  std::span<const RigidSubmap> submaps() const { return submaps_; }

  /// The pose of a node as seen from an earlier one, as uncertain as the edges between them tell.
  /// Complexity: linear in the nodes between.
  UncertainPose2 Relative(NodeId from, NodeId to) const;

 private:
  UncertainPose2 Attach(const ScanNode& node, std::span<const ScanPoint> points) const;
  MatchResult MatchAfterSlip(const SurfaceMap& reference,
                             std::span<const ScanPoint> points,
                             const UncertainPose2& predicted) const;
  void InsertIntoSubmaps(NodeId id, std::span<const ScanPoint> points);

  ScanMapOptions map_options_;
  ScanLocatorOptions locator_;
  WeightedScanMatcher matcher_;
  std::vector<Pose2> T_chain_node_;
  std::vector<PoseEdge> edges_;
  std::vector<RigidSubmap> submaps_;
  Pose2 T_map_last_;  // Of the last node, as it was answered.
};

}  // namespace qwsm
