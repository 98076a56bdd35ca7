// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// Says which earlier scans may show the same place again (Nüchter et al. 2007, section 3.4).
struct LoopOptions {
  bool enabled = true;
  int min_scans_between = 10;  ///< Scans nearer in the sequence are no loop.
  double max_distance_m = 15.0;
  /// Scans farther apart than this share of the scanner's range are no loop.
  double max_range_share = 0.5;
  int max_hypotheses = 3;  ///< So many of the nearest scans are tried.
};

template <class Visitor>
void Describe(Visitor& visit, LoopOptions& o) {
  visit("enabled", o.enabled, {.help = "look for loops and close them"});
  visit("min_scans_between",
        o.min_scans_between,
        {.help = "scans nearer in the sequence are no loop", .min = 1, .max = 1e6});
  visit("max_distance_m",
        o.max_distance_m,
        {.help = "scans farther apart are not tried", .min = 0, .max = 1e6});
  visit("max_range_share",
        o.max_range_share,
        {.help = "nor those farther apart than this share of the scanner's range",
         .min = 0,
         .max = 2});
  visit("max_hypotheses",
        o.max_hypotheses,
        {.help = "earlier scans tried, the nearest first", .min = 0, .max = 1000});
}

/// The earlier scans that the last of the poses may have come back to, nearest first.
/// @param range_m how far the scanner sees.
std::vector<std::size_t> LoopHypotheses(std::span<const Pose3> T_map_scan,
                                        double range_m,
                                        const LoopOptions& options);

}  // namespace slam6d
