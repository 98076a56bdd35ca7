// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/loop_closure_options.hpp"
#include "qwsm/mapping/pose_prediction.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/correlative_search.hpp"
#include "qwsm/matching/weighted_scan_matcher.hpp"

namespace qwsm {

struct PlaceFit;

struct ScanLocatorOptions {
  CorrelativeSearchOptions search;
  WeightedScanMatcherOptions matcher;
  LoopClosureOptions loop_closure;
  double narrow_share = 0.25;
  double confident_overlap = 0.9;
  double confident_score = 0.8;
  double max_reduced_chi2 = 2.0;
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
  visit("loop_closure",
        o.loop_closure,
        {.help = "recognising surfaces that were mapped with less drift",
         .formerly = "known_places"});
  visit("narrow_share",
        o.narrow_share,
        {.help = "share of the window that is searched first", .min = 0, .max = 1});
  visit("confident_overlap",
        o.confident_overlap,
        {.help = "the whole window is searched where less of the scan agrees with the map",
         .min = 0,
         .max = 1});
  visit("confident_score",
        o.confident_score,
        {.help = "the whole window is searched where the pose found in its first share scores less",
         .min = 0,
         .max = 1});
  visit(
      "max_reduced_chi2",
      o.max_reduced_chi2,
      {.help = "a wider search follows where the pairs' squared errors are more times the modelled",
       .formerly = "max_misfit",
       .min = 0.1,
       .max = 1000});
  visit("search_spacing_m",
        o.search_spacing_m,
        {.help = "points of the scan this near to each other count once in searches",
         .min = 0,
         .max = 10});
  visit("search_error_m",
        o.search_error_m,
        {.help = "sigma of the pose that a search finds", .min = 0.001, .max = 1});
  visit("window_sigmas",
        o.window_sigmas,
        {.help = "half the search window, in sigmas of the prediction", .min = 0, .max = 10});
  visit("max_window_m",
        o.max_window_m,
        {.help = "most that half the search window measures", .min = 0, .max = 100});
  visit("max_window_rad",
        o.max_window_rad,
        {.help = "most that half the range of headings measures", .min = 0, .max = 3.2});
  visit("widen_below_overlap",
        o.widen_below_overlap,
        {.help = "a wider search follows where less of the scan agrees with the map",
         .min = 0,
         .max = 1});
  visit(
      "widen_factor",
      o.widen_factor,
      {.help = "factor on the sigmas of the prediction in the wider search", .min = 1, .max = 20});
  visit("widen_gain",
        o.widen_gain,
        {.help = "the wider search is believed if that much more of the scan agrees",
         .min = 0,
         .max = 1});
}

/// Finds where in the map a scan was taken, from a rough prediction.
class ScanLocator {
 public:
  explicit ScanLocator(const ScanLocatorOptions& options = {})
      : options_(options), matcher_(options.matcher) {}

  /// Searches around the prediction, then matches from the best pose found. The window is narrow
  /// first, for most predictions are better than their worst case; as wide as the prediction is
  /// uncertain where not nearly all of the scan is explained or the pose found is not likely; and
  /// wider still where little of it is explained or it fits badly, for then odometry has jumped or
  /// slipped, or the pose is that of a neighbouring minimum.
  ///
  /// @param predicted pose of the robot in the map.
  /// @param seen_free what ends there has moved and is left out of the match.
  MatchResult Locate(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const UncertainPose2& predicted,
                     const FreeSpace& seen_free = FreeSpace{}) const;

  /// The same, if some pose explains so much of the scan: what explains less may not be found,
  /// which spares most of the search, and none is matched.
  std::optional<MatchResult> LocateExplaining(const ScanMap& map,
                                              std::span<const ScanPoint> points,
                                              const UncertainPose2& predicted,
                                              double least_explained,
                                              const FreeSpace& seen_free) const;

  /// The same, but never farther off than the prediction is uncertain.
  std::optional<MatchResult> LocateWithin(const ScanMap& map,
                                          std::span<const ScanPoint> points,
                                          const UncertainPose2& predicted,
                                          double least_explained,
                                          const FreeSpace& seen_free) const;

  /// Locates where odometry tells the prediction: it is as good as it has proved, or the wheels
  /// have slipped. That they have, once in a hundred scans, the scan has to tell: by where it is
  /// found, or by what more of it agrees with the map elsewhere.
  MatchResult Locate(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const PosePrediction& predicted,
                     const FreeSpace& seen_free = FreeSpace{}) const;

  const ScanLocatorOptions& options() const { return options_; }

 private:
  std::optional<MatchResult> LocateByWhatStands(const ScanMap& map,
                                                std::span<const ScanPoint> points,
                                                const UncertainPose2& expected,
                                                const PlaceFit& elsewhere,
                                                const FreeSpace& seen_free) const;

  ScanLocatorOptions options_;
  WeightedScanMatcher matcher_;
};

}  // namespace qwsm
