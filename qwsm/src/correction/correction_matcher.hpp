// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

/// How corrections match scans. A submap is what a robot saw from one place and ends close by: a
/// scan's points beyond its ends would turn the match, and let it be more certain than it is.
inline WeightedScanMatcher CorrectionMatcher(WeightedScanMatcherOptions options) {
  options.selection = PairSelection::kOneToOne;
  return WeightedScanMatcher(options);
}

}  // namespace qwsm
