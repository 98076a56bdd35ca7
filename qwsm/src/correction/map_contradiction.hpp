// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "qwsm/correction/scan_node.hpp"
#include "qwsm/mapping/free_space.hpp"

namespace qwsm {

/// How many points of scans lie where other scans near by, of any pass, saw through: so much a map
/// contradicts what was seen. Walking people are a part of it that no poses change.
struct Contradiction {
  std::size_t looked_at = 0;
  std::size_t seen_through = 0;

  double share() const;
};

/// Whether there is more of it than chance explains.
bool IsWorse(const Contradiction& after, const Contradiction& before);

/// Whether most of it is gone: more than half, and more than chance explains.
bool IsMostlyResolved(const Contradiction& after, const Contradiction& before);

/// Counts the contradiction of scans at these poses. Complexity: linear in the pairs of scans that
/// are near each other; of all scans, every fourth is asked.
/// @param T_map_node by node
Contradiction ContradictionAt(std::span<const ScanNode> nodes,
                              std::span<const Pose2> T_map_node,
                              const FreeSpaceOptions& options);

}  // namespace qwsm
