// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/graph/pose_graph.hpp"
#include "qwsm/mapping/mapping_step.hpp"

namespace qwsm {

/// The path of all scans, hung on those that are nodes of the graph.
class AnchoredPath {
 public:
  /// Takes the answer to a scan. If it is relevant, it is a node, the first one being node 0.
  /// @param map_last the last node in the map of the answer; none where nothing ties them.
  void Take(const MappingStep& step, const std::optional<UncertainPose2>& map_last);
  /// Takes a node that is no answer's, and tied to none before.
  void TakeNode() { anchors_.emplace_back(); }

  /// Number of answers that were taken.
  std::size_t size() const { return answers_.size(); }
  /// Forgets the answers from one on, and the nodes from one on.
  void ForgetSince(std::size_t first_answer, NodeId first_node);

  /// The path when the nodes are there. Between two nodes it goes from the correction of the one
  /// to that of the other, scan by scan, and most of the way where an answer went elsewhere than
  /// odometry; where the answers did not continue, it keeps the first.
  std::vector<UncertainPose2> At(std::span<const UncertainPose2> map_node) const;
  /// Likewise where some nodes are in another map, or in none. @return none of answers beside
  /// these.
  std::vector<std::optional<UncertainPose2>> At(
      std::span<const std::optional<UncertainPose2>> map_node) const;

 private:
  struct Answer {
    UncertainPose2 node_robot;   // As seen from that node; else in the map.
    std::optional<NodeId> node;  // The last one before it, or itself.
    double strain = 0.0;         // Sum of StrainOf() of the answers since that node.
  };
  struct Anchor {
    std::optional<Pose2> T_last_this;  // As seen from the node before, if the answers continued.
    double strain = 0.0;               // Likewise since the node before.
  };

  double StrainOf(const MappingStep& step, const std::optional<UncertainPose2>& map_last) const;
  std::optional<UncertainPose2> Place(
      const Answer& answer, std::span<const std::optional<UncertainPose2>> map_node) const;

  std::vector<Answer> answers_;
  std::vector<Anchor> anchors_;  // By node.
};

}  // namespace qwsm
