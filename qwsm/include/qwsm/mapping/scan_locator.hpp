// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

struct ScanLocatorOptions {
  CorrelativeSearchOptions search;
  WeightedScanMatcherOptions matcher;
  double search_spacing_m = 0.15;
  double search_error_m = 0.022;
  double window_sigmas = 3.0;
  double max_window_m = 3.0;
  double max_window_rad = 1.4;
  double widen_below_overlap = 0.5;
  double widen_factor = 3.0;
  double widen_gain = 0.15;
  double return_drift_m = 0.3;
  double return_drift_share = 0.5;
  double return_sigmas = 2.5;
  double return_max_window_m = 4.0;
  double return_max_window_rad = 0.35;
  double return_min_known = 0.5;
  double return_min_score = 0.4;
  double return_gain = 0.08;
};

template <class Visitor>
void Describe(Visitor& visit, ScanLocatorOptions& o) {
  visit("search", o.search, {.help = "the coarse-to-fine search for the first guess"});
  visit("matcher", o.matcher, {.help = "the weighted match that follows"});
  visit("search_spacing_m",
        o.search_spacing_m,
        {.help = "points of the scan this near count once in searches", .min = 0, .max = 10});
  visit("search_error_m",
        o.search_error_m,
        {.help = "how far off the found pose may be", .min = 0.001, .max = 1});
  visit("window_sigmas",
        o.window_sigmas,
        {.help = "half the search window, in sigmas of the prediction", .min = 0, .max = 10});
  visit("max_window_m", o.max_window_m, {.help = "and at most this far", .min = 0, .max = 100});
  visit("max_window_rad", o.max_window_rad, {.help = "and this turn", .min = 0, .max = 3.2});
  visit("widen_below_overlap",
        o.widen_below_overlap,
        {.help = "search wider where less of the scan agrees with the map", .min = 0, .max = 1});
  visit("widen_factor", o.widen_factor, {.help = "this much wider", .min = 1, .max = 20});
  visit("widen_gain",
        o.widen_gain,
        {.help = "and believe it if that much more agrees", .min = 0, .max = 1});
  visit("return_drift_m",
        o.return_drift_m,
        {.help = "look for known places once the drift since then reaches this sigma",
         .min = 0.01,
         .max = 100});
  visit("return_drift_share",
        o.return_drift_share,
        {.help = "known is what has less than this share of the variance now", .min = 0, .max = 1});
  visit("return_sigmas",
        o.return_sigmas,
        {.help = "half the window, in sigmas of the drift", .min = 0, .max = 10});
  visit("return_max_window_m",
        o.return_max_window_m,
        {.help = "and at most this far", .min = 0, .max = 100});
  visit("return_max_window_rad",
        o.return_max_window_rad,
        {.help = "and this turn", .min = 0, .max = 3.2});
  visit("return_min_known",
        o.return_min_known,
        {.help = "share of the scan that must end near known surfaces", .min = 0, .max = 1});
  visit("return_min_score",
        o.return_min_score,
        {.help = "score on known surfaces that proves a return", .min = 0, .max = 1});
  visit("return_gain",
        o.return_gain,
        {.help = "and by how much it must beat the pose without return", .min = 0, .max = 1});
}

/// Finds where in the map a scan was taken, from a rough prediction.
class ScanLocator {
 public:
  explicit ScanLocator(const ScanLocatorOptions& options = {})
      : options_(options), matcher_(options.matcher) {}

  /// Searches the window of the prediction, then matches from the best pose found. Where the result
  /// explains little of the scan, odometry has jumped or slipped: a wider window is searched too.
  ///
  /// @param predicted pose of the robot in the map; covariance of the motion since the last scan.
  MatchResult Locate(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const UncertainPose2& predicted,
                     MatchTrace* trace = nullptr) const;

  /// Looks for the scan among the surfaces mapped long ago, with much less drift than `estimated`.
  ///
  /// A wrong jump is worse than drift: nothing is returned unless most of the scan fits there, much
  /// better than at the estimate, within what the drift since can have been.
  /// @param estimated pose of the robot in the map; covariance of all drift since the start.
  std::optional<MatchResult> FindReturn(const ScanMap& map,
                                        std::span<const ScanPoint> points,
                                        const UncertainPose2& estimated) const;

  const ScanLocatorOptions& options() const { return options_; }

 private:
  MatchResult SearchAndMatch(const ScanMap& map,
                             std::span<const ScanPoint> points,
                             const UncertainPose2& predicted,
                             MatchTrace* trace) const;

  ScanLocatorOptions options_;
  WeightedScanMatcher matcher_;
};

}  // namespace qwsm
