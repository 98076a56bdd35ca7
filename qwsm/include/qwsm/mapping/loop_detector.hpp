// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

/// A robot is back among surfaces that were mapped long before.
struct ClosedLoop {
  MatchResult match;         ///< With these surfaces.
  UncertainPose2 map_robot;  ///< The pose found, as uncertain as they are, too.
};

/// Detects that a robot closes a loop: that it is back among surfaces which were mapped with much
/// less drift than its pose has now, and finds its pose among them.
class LoopDetector {
 public:
  explicit LoopDetector(const ScanLocatorOptions& options = {})
      : options_(options), matcher_(options.matcher) {}

  /// A wrong loop closure is worse than drift: nothing is returned unless the submap fits there and
  /// not where it is estimated, and either fits nowhere else within what the drift since can have
  /// been, or leads to the same pose from each candidate once the estimate has its say.
  ///
  /// @param submap points of the last scans, thinned, as the robot sees them now.
  /// @param estimated pose of the robot in the map; covariance of all drift since the start.
  std::optional<ClosedLoop> Detect(const ScanMap& map,
                                   std::span<const ScanPoint> points,
                                   std::span<const ScanPoint> submap,
                                   const UncertainPose2& estimated) const;

 private:
  ScanLocatorOptions options_;
  WeightedScanMatcher matcher_;
};

}  // namespace qwsm
