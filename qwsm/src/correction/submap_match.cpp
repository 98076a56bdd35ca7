// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "submap_match.hpp"

#include <algorithm>

namespace qwsm {
namespace {

// A match finds its way from so far.
constexpr double kMatchReach_m = 0.15;
constexpr double kMatchReach_rad = 0.04;
constexpr double kMaxSearchWindow_m = 15.0;
constexpr double kMaxReducedChi2 = 2.5;

std::optional<FoundPose> Search(SubmapSurfaces& submap,
                                std::span<const ScanPoint> points,
                                const UncertainPose2& predicted,
                                const ScanLocatorOptions& options) {
  const SearchWindow window{
      .predicted = predicted,
      .translation_m = std::min(kMaxSearchWindow_m, options.window_sigmas * predicted.SigmaXY_m()),
      .rotation_rad =
          std::min(options.max_window_rad, options.window_sigmas * predicted.SigmaTheta_rad())};
  const std::vector<Eigen::Vector2d> thinned =
      PositionsOf(ThinOut(points, options.search_spacing_m));
  return SearchPose(submap.likelihood(), thinned, window, options.search);
}

}  // namespace

MatchResult LocateAmong(SubmapSurfaces& submap,
                        std::span<const ScanPoint> points,
                        const UncertainPose2& predicted,
                        const ScanLocatorOptions& options,
                        const WeightedScanMatcher& matcher) {
  MatchPrior prior{.predicted = predicted,
                   .start = predicted.T_a_b,
                   .start_error = {.translation_m = predicted.SigmaXY_m(),
                                   .rotation_rad = predicted.SigmaTheta_rad()}};
  if (predicted.SigmaXY_m() > kMatchReach_m || predicted.SigmaTheta_rad() > kMatchReach_rad) {
    if (const auto found = Search(submap, points, predicted, options)) {
      prior.start = found->T_map_robot;
      prior.start_error = {.translation_m = options.search_error_m};
    }
  }
  return matcher.Match(submap.surfaces(), points, prior);
}

bool IsRecognised(const MatchResult& match, double min_overlap) {
  return match.status == MatchStatus::kConverged && match.overlap >= min_overlap &&
         match.reduced_chi2 <= kMaxReducedChi2;
}

Eigen::Matrix3d InformationOfPairs(const MatchResult& match,
                                   const WeightedScanMatcherOptions& options) {
  return match.pair_information / options.correlated_points;
}

}  // namespace qwsm
