// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "qwsm/correction/scan_node.hpp"
#include "scan_chains.hpp"

namespace qwsm {

/// The path on which scans agree best with each other, near the one that the graph tells: each scan
/// is matched with what all others show, those taken after it, too, and is held by its chain. A
/// loop is told by one submap; this is by all that ever saw the same.
///
/// Descends by blocks of coordinates: every other turn of scans moves, and the rest, whose surfaces
/// they are matched with, stays meanwhile. Scans that match nothing go with their neighbours.
/// Complexity: as inserting and matching all scans, times the sweeps.
/// @param T_map_node poses of the nodes, as the graph has them
/// @pre all nodes were added to the chains
std::vector<Pose2> RefinedPath(std::span<const ScanNode> nodes,
                               const ScanChains& chains,
                               const WeightedScanMatcher& matcher,
                               std::vector<Pose2> T_map_node);

}  // namespace qwsm
