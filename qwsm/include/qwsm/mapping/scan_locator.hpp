// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

/// When a place counts as seen before, and where it is looked for.
struct ReturnOptions {
  CorrelativeSearchOptions search{.prior_points = 0.15, .lever_m = 8.0};
  double caution = 6.0;
  double min_drift_m = 0.5;
  double max_drift_share = 0.5;
  double min_known_share = 0.5;
  double window_sigmas = 2.5;
  double max_window_m = 4.0;
  double max_window_rad = 0.35;
  double min_score = 0.3;
  double uniqueness = 0.06;
  double min_overlap = 0.7;
};

template <class Visitor>
void Describe(Visitor& visit, ReturnOptions& o) {
  visit("search", o.search, {.help = "the search among surfaces seen long ago"});
  visit(
      "caution",
      o.caution,
      {.help = "the world may be this much less kind than the error model", .min = 1, .max = 100});
  visit("min_drift_m",
        o.min_drift_m,
        {.help = "sigma of the drift since, from which on to look", .min = 0.01, .max = 100});
  visit("max_drift_share",
        o.max_drift_share,
        {.help = "known is what has less than this share of today's variance", .min = 0, .max = 1});
  visit("min_known_share",
        o.min_known_share,
        {.help = "share of the surroundings that ends near known surfaces", .min = 0, .max = 1});
  visit("window_sigmas",
        o.window_sigmas,
        {.help = "half the window, in sigmas of the drift", .min = 0, .max = 10});
  visit("max_window_m", o.max_window_m, {.help = "and at most this far", .min = 0, .max = 100});
  visit("max_window_rad", o.max_window_rad, {.help = "and this turn", .min = 0, .max = 3.2});
  visit("min_score", o.min_score, {.help = "score that proves a return", .min = 0, .max = 1});
  visit("uniqueness",
        o.uniqueness,
        {.help = "by how much it must beat every other place", .min = 0, .max = 1});
  visit("min_overlap",
        o.min_overlap,
        {.help = "share of the scan that then agrees with known surfaces", .min = 0, .max = 1});
}

struct ScanLocatorOptions {
  CorrelativeSearchOptions search;
  WeightedScanMatcherOptions matcher;
  ReturnOptions known_places;
  double narrow_share = 0.25;
  double confident_overlap = 0.9;
  double search_spacing_m = 0.12;
  double search_error_m = 0.022;
  double window_sigmas = 3.0;
  double max_window_m = 3.0;
  double max_window_rad = 1.4;
  double widen_below_overlap = 0.5;
  double widen_factor = 3.0;
  double widen_gain = 0.15;
};

template <class Visitor>
void Describe(Visitor& visit, ScanLocatorOptions& o) {
  visit("search", o.search, {.help = "the coarse-to-fine search for the first guess"});
  visit("matcher", o.matcher, {.help = "the weighted match that follows"});
  visit("known_places", o.known_places, {.help = "returning to places seen long ago"});
  visit("narrow_share",
        o.narrow_share,
        {.help = "first search only this share of the window", .min = 0, .max = 1});
  visit("confident_overlap",
        o.confident_overlap,
        {.help = "and all of it where less of the scan agrees with the map", .min = 0, .max = 1});
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
}

/// Finds where in the map a scan was taken, from a rough prediction.
class ScanLocator {
 public:
  explicit ScanLocator(const ScanLocatorOptions& options = {})
      : options_(options), matcher_(options.matcher) {}

  /// Searches around the prediction, then matches from the best pose found. The window is narrow
  /// first, for most predictions are better than their worst case; as wide as the prediction is
  /// uncertain where not nearly all of the scan is explained; and wider still where little of it
  /// is, for then odometry has jumped or slipped.
  ///
  /// @param predicted pose of the robot in the map.
  /// @param seen_free what ends there has moved and is left out of the match.
  MatchResult Locate(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const UncertainPose2& predicted,
                     const FreeSpace& seen_free = FreeSpace{}) const;

  /// Looks for the robot among the surfaces mapped long ago, with much less drift than `estimated`.
  ///
  /// A wrong jump is worse than drift: nothing is returned unless the surroundings fit there, fit
  /// nowhere else within what the drift since can have been, and not where they are estimated.
  /// @param surroundings_robot_m points of the last scans, thinned, in the robot's frame.
  /// @param estimated pose of the robot in the map; covariance of all drift since the start.
  std::optional<MatchResult> FindReturn(const ScanMap& map,
                                        std::span<const ScanPoint> points,
                                        std::span<const Eigen::Vector2d> surroundings_robot_m,
                                        const UncertainPose2& estimated) const;

  const ScanLocatorOptions& options() const { return options_; }

 private:
  bool IsHeldByPairs(const MatchResult& match) const;
  std::optional<Pose2> OnlyPlace(const LikelihoodPyramid& map,
                                 std::span<const Eigen::Vector2d> surroundings_robot_m,
                                 SearchWindow window) const;

  ScanLocatorOptions options_;
  WeightedScanMatcher matcher_;
};

}  // namespace qwsm
