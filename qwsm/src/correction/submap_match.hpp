// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "qwsm/mapping/scan_locator.hpp"
#include "submap_surfaces.hpp"

namespace qwsm {

/// Finds a scan in a submap: searches as far as the prediction is uncertain, if it is too
/// uncertain for a match to start from it, then matches.
MatchResult LocateAmong(SubmapSurfaces& submap,
                        std::span<const ScanPoint> points,
                        const UncertainPose2& predicted,
                        const ScanLocatorOptions& options,
                        const WeightedScanMatcher& matcher);

/// Whether a match explains a scan so well that a place can be recognised by it.
bool IsRecognised(const MatchResult& match, double min_overlap);

/// What the pairs of a match tell of (x, y, theta); neighbouring points are correlated.
Eigen::Matrix3d InformationOfPairs(const MatchResult& match,
                                   const WeightedScanMatcherOptions& options);

}  // namespace qwsm
