// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "qwsm/correction/loop.hpp"
#include "qwsm/correction/scan_node.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// A map and a path that are consistent as a whole.
struct Correction {
  std::vector<UncertainPose2> map_node;   ///< Poses of the relevant scans, by ScanId.
  std::vector<UncertainPose2> map_robot;  ///< Poses of all scans, in the order they were taken.
  PoseGraph graph;                        ///< The graph with the loops that are accepted.
  std::vector<Loop> loops;                ///< All loops that were found.
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

  /// Takes the answer to a scan; to be called for all scans in their order.
  void Take(const MappingStep& step);

  /// Finds the loops among what was taken so far, and the poses that agree best with them. Where
  /// the map would contradict the scans more than before, poses stay as they were answered.
  Correction Correct() const;

 private:
  struct State;

  std::unique_ptr<State> state_;
};

/// The scans of a map, inserted anew at other poses in the order they were recorded.
/// @param map_node by ScanId. @pre as many as the map has scans.
ScanMap Reinserted(const ScanMap& map, const std::vector<UncertainPose2>& map_node);

}  // namespace qwsm
