// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/loop_hypotheses.hpp"

#include <algorithm>

namespace slam6d {

std::vector<std::size_t> LoopHypotheses(std::span<const Pose3> T_map_scan,
                                        double range_m,
                                        const LoopOptions& options) {
  const auto gap = static_cast<std::size_t>(options.min_scans_between);
  if (!options.enabled || T_map_scan.size() <= gap) return {};
  const auto distance_m = [&](std::size_t scan) {
    return (T_map_scan[scan].translation_m - T_map_scan.back().translation_m).norm();
  };
  const double limit_m = std::min(options.max_distance_m, options.max_range_share * range_m);
  std::vector<std::size_t> hypotheses;
  for (std::size_t scan = 0; scan + gap < T_map_scan.size(); ++scan) {
    if (distance_m(scan) <= limit_m) hypotheses.push_back(scan);
  }
  std::ranges::stable_sort(hypotheses, {}, distance_m);
  hypotheses.resize(std::min(hypotheses.size(), static_cast<std::size_t>(options.max_hypotheses)));
  return hypotheses;
}

}  // namespace slam6d
