// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "qwsm/graph/pose_graph.hpp"

namespace qwsm {

/// What became of a place that was recognised.
enum class LoopVerdict : std::uint8_t {
  kAccepted,      ///< The poses are corrected by it.
  kUnconfirmed,   ///< Too few loops of scans near by agree, or they tell too little.
  kContradicted,  ///< The rest of the graph disagrees.
  kRefused,       ///< With the loops the map would contradict the scans more than without.
};

std::string_view Name(LoopVerdict verdict);

/// A scan that was matched with a submap of an earlier pass.
struct Loop {
  PoseEdge edge;              ///< Edge from the submap's reference scan to the scan.
  double overlap = 0.0;       ///< Share of the scan's points that agree with the submap.
  double reduced_chi2 = 0.0;  ///< Mean squared error of the pairs, in units of its variance.
  LoopVerdict verdict = LoopVerdict::kUnconfirmed;
};

}  // namespace qwsm
