// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/scan_node.hpp"
#include "qwsm/graph/pose_graph.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"
#include "scan_turns.hpp"
#include "submap_surfaces.hpp"

namespace qwsm {

/// A few turns of scans in a row as one rigid body, in the frame of their chain.
struct RigidSubmap {
  std::size_t robot = 0;      ///< Whose scans they are.
  std::size_t ordinal = 0;    ///< Among the submaps of that robot.
  std::vector<NodeId> nodes;  ///< In a row.
  /// How wrong its surfaces lie, (x, y, theta) along the chain's axes, as its first scan sees them:
  /// as the next scan, which sees the same and was matched. Nothing, where that first one has drawn
  /// them alone.
  Eigen::Matrix3d error_of_surfaces = Eigen::Matrix3d::Zero();

  /// The scan in the middle, which stands for all.
  NodeId reference() const { return nodes[nodes.size() / 2]; }
};

/// A node that was matched with the surfaces of the submap before.
struct SurfaceMatch {
  std::size_t submap = 0;
  NodeId node = 0;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< Along the axes of its chain.
};

/// The relevant scans of each robot in a row, each matched with those just before it, in a frame of
/// their own that no closed loop bends: the backbone of the pose graph. Where several lasers take
/// turns, what they see in a turn is matched as one; until a turn is complete its scans hang on
/// each other as they were answered.
class ScanChains {
 public:
  explicit ScanChains(const MapperOptions& options);

  /// Adds the last of the nodes to the chain of its robot. @pre all before were added
  void Add(std::span<const ScanNode> nodes);
  /// Forgets the last nodes, as if they had never been added.
  /// @param nodes those before, which are left.
  /// Complexity: that of adding the submaps that still grow.
  void ForgetSince(std::span<const ScanNode> nodes);

  /// Poses of the nodes, each in the frame of its chain.
  std::span<const Pose2> T_chain_node() const { return T_chain_node_; }
  /// Edges from each node to the next of its robot, and to the first one of each robot from that of
  /// all, or from one beside which it was found.
  std::span<const PoseEdge> edges() const { return edges_; }
  /// What the edges are made of: each node's motion from the one before, with where each robot came
  /// in, and its match.
  std::span<const PoseEdge> motions() const { return motions_; }
  std::span<const SurfaceMatch> matches() const { return matches_; }
  /// Submaps of the chains, which overlap by half.
  std::span<const RigidSubmap> submaps() const { return submaps_; }
  /// How many robots there are.
  std::size_t robots() const { return chains_.size(); }
  /// Whose chain a node belongs to.
  std::size_t RobotOf(NodeId node) const { return robot_[node]; }
  /// Which turn of its robot's lasers a node was taken in.
  std::size_t TurnOf(NodeId node) const { return parts_[node].turn; }
  /// How many turns of its robot's lasers a node is behind an earlier one; none if they are two
  /// robots'.
  std::optional<std::size_t> TurnsBetween(NodeId from, NodeId to) const {
    if (robot_[from] != robot_[to]) return std::nullopt;
    return parts_[to].turn - parts_[from].turn;
  }
  /// Whether all lasers of its robot have scanned in a node's turn.
  bool CompletesTurn(NodeId node) const { return parts_[node].completes; }
  /// What was seen at a node, with what the robot's other lasers have just seen, in the frame of
  /// the robot at that node. @param nodes all that were added
  std::vector<ScanPoint> PointsAround(NodeId node, std::span<const ScanNode> nodes) const {
    return WithThoseBeside(ToPoints(nodes[node].scan), node, T_chain_node_[node], nodes);
  }

  /// How points are stored of scans that serve others like them.
  const ScanMapOptions& map_options() const { return map_options_; }
  /// The surfaces that the scans of a submap show, in the frame of the chain.
  /// @param nodes all that were added
  SubmapSurfaces SurfacesOf(const RigidSubmap& submap, std::span<const ScanNode> nodes) const;

  /// The pose of a node as seen from an earlier one of the same robot, as uncertain as the edges
  /// between them tell.
  /// Complexity: linear in the nodes between.
  UncertainPose2 Relative(NodeId from, NodeId to) const;

 private:
  struct Chain {
    std::vector<NodeId> nodes;
    ScanTurns turns;
    std::vector<std::size_t> submaps;          // Indices of its own.
    std::deque<SubmapSurfaces> last_surfaces;  // Of the last two submaps, which still grow.
    int unmatched = 0;                         // So many of the last nodes fit no surfaces.
  };

  // A node in its chain, and where that is known from, along the axes of the chain.
  struct Attachment {
    UncertainPose2 chain_node;                           // As seen from the node before.
    Eigen::Matrix3d of_motion;                           // Information of the motion since that.
    Eigen::Matrix3d of_match = Eigen::Matrix3d::Zero();  // And of the match, if there is one.
  };

  void Begin(const ScanNode& node);
  Attachment Hang(const ScanNode& node, const Chain& chain) const;
  Attachment Attach(NodeId id,
                    const std::vector<ScanPoint>& own_points,
                    std::span<const ScanNode> nodes,
                    Chain& chain) const;
  Attachment Matched(const MatchResult& match,
                     const UncertainPose2& predicted,
                     const Eigen::Matrix3d& growth) const;
  void NoteMotion(const Attachment& attached);
  void NoteMatch(NodeId id, const Attachment& attached, const Chain& chain);
  std::vector<ScanPoint> WithThoseBeside(std::vector<ScanPoint> points,
                                         NodeId node,
                                         const Pose2& T_chain_robot,
                                         std::span<const ScanNode> nodes) const;
  static void NoteHold(const Attachment& attached, Chain& chain);
  void ForgetSubmapsSince(NodeId first);
  void GoOn(std::span<const ScanNode> nodes, Chain& chain);
  void BeginSubmap(NodeId id, Chain& chain);
  void InsertIntoSubmaps(NodeId id, std::span<const ScanPoint> points, Chain& chain);
  void Insert(NodeId id, std::span<const ScanPoint> points, SubmapSurfaces& submap) const;
  SubmapSurfaces Drawn(const RigidSubmap& submap, std::span<const ScanNode> nodes) const;

  ScanMapOptions map_options_;
  FreeSpaceOptions free_space_;
  ScanLocatorOptions locator_;
  WeightedScanMatcher matcher_;
  UncertainPose2 map_first_;            // Pose of the first node of all.
  std::vector<Pose2> T_chain_node_;     // By node.
  std::vector<std::size_t> position_;   // By node.
  std::vector<std::size_t> robot_;      // By node.
  std::vector<ScanTurns::Part> parts_;  // By node.
  std::vector<int> unmatched_;          // By node: of its chain then.
  std::vector<PoseEdge> edges_;         // To each node but the first.
  std::vector<PoseEdge> motions_;       // To each node but the first.
  std::vector<SurfaceMatch> matches_;
  std::vector<RigidSubmap> submaps_;     // In the order they were begun.
  std::map<std::size_t, Chain> chains_;  // By robot.
};

}  // namespace qwsm
