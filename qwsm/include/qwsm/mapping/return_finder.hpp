// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

/// Finds a robot that is back among surfaces mapped long ago, with much less drift than it has now.
class ReturnFinder {
 public:
  explicit ReturnFinder(const ScanLocatorOptions& options = {})
      : options_(options), matcher_(options.matcher) {}

  /// A wrong jump is worse than drift: nothing is returned unless the surroundings fit there and
  /// not where they are estimated, and either fit nowhere else within what the drift since can have
  /// been, or lead to the same pose from each place they fit at once the estimate has its say.
  ///
  /// @param surroundings points of the last scans, thinned, as the robot sees them now.
  /// @param estimated pose of the robot in the map; covariance of all drift since the start.
  /// @return with the covariance of the pose in the map, drift of the known surfaces included.
  std::optional<MatchResult> Find(const ScanMap& map,
                                  std::span<const ScanPoint> points,
                                  std::span<const ScanPoint> surroundings,
                                  const UncertainPose2& estimated) const;

 private:
  ScanLocatorOptions options_;
  WeightedScanMatcher matcher_;
};

}  // namespace qwsm
