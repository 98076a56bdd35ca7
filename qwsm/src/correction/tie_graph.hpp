// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "loop_agreement.hpp"
#include "qwsm/graph/pose_graph.hpp"
#include "scan_chains.hpp"

namespace qwsm {

/// What the poses of all scans are known from, for how uncertain they are.
///
/// Each scan's motion, its match with the surfaces just before, and its loops. The surfaces of the
/// submaps are nodes behind those of the scans: what they are wrong by counts once, however many
/// scans were matched with them. The edges of the chains, by which poses bend where they should,
/// count it at each step.
/// @param T_map_node of all scans.
/// @param loops those that are accepted count.
PoseGraph TieGraph(const ScanChains& chains,
                   std::span<const Pose2> T_map_node,
                   std::span<const FoundLoop> loops);

}  // namespace qwsm
