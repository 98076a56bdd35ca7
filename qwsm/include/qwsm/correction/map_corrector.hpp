// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/loop.hpp"
#include "qwsm/correction/scan_node.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// A map and a path that are consistent as a whole.
struct Correction {
  std::vector<UncertainPose2> map_node;  ///< Poses of the relevant scans, by ScanId.
  /// Poses of all scans of a robot, in the order they were taken; empty where only nodes are known.
  std::vector<UncertainPose2> map_robot;
  PoseGraph graph;          ///< The graph with the loops that are accepted.
  std::vector<Loop> loops;  ///< All loops that were found.
};

/// Corrects a map that was made incrementally, once places are seen again: relevant scans become
/// the nodes of a pose graph, matches with the scans just before and with those of other passes
/// its edges. Deterministic; reads no clock.
class MapCorrector {
 public:
  explicit MapCorrector(const MapperOptions& options = {});
  ~MapCorrector();
  MapCorrector(MapCorrector&&) noexcept;
  MapCorrector& operator=(MapCorrector&&) noexcept;

  /// Takes a relevant scan; to be called for all of them in their order. Its pose is one in the map
  /// as it is after all corrections that were adopted.
  void Add(ScanNode node);

  /// The poses of the nodes as the loops found so far would have them, if the map contradicts
  /// itself and most of that is gone there: while the robots drive.
  std::optional<std::vector<UncertainPose2>> Propose();
  /// From now on the map is drawn there. @param map_node of the nodes so far, or the first of them.
  void Adopt(std::span<const UncertainPose2> map_node);
  /// Forgets the last nodes, as if they had never been added. @param first of them.
  void ForgetSince(NodeId first);
  /// The nodes' scans inserted at these poses, in the order they were taken.
  ScanMap MapAt(std::span<const UncertainPose2> map_node) const;
  /// The nodes' scans at these poses, when they are not needed here any more.
  /// @param map_node of all nodes.
  std::vector<RelevantScan> ScansAt(std::span<const UncertainPose2> map_node) &&;

  /// Finds the loops among what was taken so far, the poses that agree best with them, and from
  /// there those on which every scan agrees best with all others. Where the map would contradict
  /// the scans more than before, poses stay as they are.
  Correction Correct();

 private:
  struct State;

  std::unique_ptr<State> state_;
};

}  // namespace qwsm
