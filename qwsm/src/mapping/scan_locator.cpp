// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_locator.hpp"

#include <algorithm>
#include <optional>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/place_evidence.hpp"

namespace qwsm {
namespace {

constexpr std::size_t kMinSearchPoints = 2;  // One fits anywhere.
// As seldom as wheels slip a pose is farther from where it is expected, of three degrees of
// freedom.
constexpr double kSlippedChi2 = 11.3;
// A pose scores at least so much of the share of the scan that it explains: mostly nine tenths.
constexpr double kLeastScore = 0.5;

// One scan to be located.
struct Task {
  const ScanLocatorOptions& options;
  const WeightedScanMatcher& matcher;
  const SurfaceMap& map;
  std::span<const ScanPoint> points;
  std::vector<Eigen::Vector2d> thinned;
  const FreeSpace& seen_free;

  // The best pose within so many sigmas of where it is expected, if it scores more than that.
  // @param searched_sigmas within so many no pose scores more.
  std::optional<FoundPose> Search(const UncertainPose2& expected,
                                  double sigmas,
                                  double min_score = 0.0,
                                  std::optional<double> searched_sigmas = {}) const {
    if (thinned.size() < kMinSearchPoints) return std::nullopt;
    const WindowReach reach = ReachOf(expected, sigmas);
    SearchWindow window{.predicted = expected,
                        .translation_m = reach.translation_m,
                        .rotation_rad = reach.rotation_rad,
                        .min_score = min_score};
    if (searched_sigmas) window.searched = ReachOf(expected, *searched_sigmas);
    return SearchPose(map.likelihood(), thinned, window, options.search);
  }

  WindowReach ReachOf(const UncertainPose2& expected, double sigmas) const {
    return {.translation_m = std::min(options.max_window_m, sigmas * expected.SigmaXY_m()),
            .rotation_rad = std::min(options.max_window_rad, sigmas * expected.SigmaTheta_rad())};
  }

  // Matches what has not moved from the pose found, or from where it is expected.
  MatchResult Match(const std::optional<FoundPose>& found, const UncertainPose2& expected) const {
    MatchPrior prior{.predicted = expected,
                     .start = expected.T_a_b,
                     .start_error = {.translation_m = expected.SigmaXY_m(),
                                     .rotation_rad = expected.SigmaTheta_rad()}};
    if (found) {
      prior.start = found->T_map_robot;
      prior.start_error = {.translation_m = options.search_error_m};
    }
    return matcher.Match(map, seen_free.WithoutMoving(points, prior.start), prior);
  }

  bool Fits(const MatchResult& match, double min_overlap) const {
    return match.overlap >= min_overlap && match.reduced_chi2 <= options.max_reduced_chi2;
  }
};

Task TaskOf(const ScanLocatorOptions& options,
            const WeightedScanMatcher& matcher,
            const ScanMap& map,
            std::span<const ScanPoint> points,
            const UncertainPose2& predicted,
            const FreeSpace& seen_free) {
  return {.options = options,
          .matcher = matcher,
          .map = map.surfaces(),
          .points = points,
          .thinned = PositionsOf(
              seen_free.WithoutMoving(ThinOut(points, options.search_spacing_m), predicted.T_a_b)),
          .seen_free = seen_free};
}

// The best match found, and how the pose that it began from scored.
struct ScoredMatch {
  MatchResult match;
  double score = 0.0;
};

// Within the window of the prediction: in the middle first, where it mostly is.
// @param min_score poses that score no better are not found.
ScoredMatch LocateIn(const Task& task, const UncertainPose2& predicted, double min_score = 0.0) {
  const double sigmas = task.options.window_sigmas;
  const double narrow_sigmas = task.options.narrow_share * sigmas;
  const auto near = task.Search(predicted, narrow_sigmas, min_score);
  const ScoredMatch narrow{.match = task.Match(near, predicted),
                           .score = near ? near->score : min_score};
  const bool is_likely = near && near->score >= task.options.confident_score;
  if (is_likely && task.Fits(narrow.match, task.options.confident_overlap)) return narrow;

  const auto better = task.Search(predicted, sigmas, narrow.score, narrow_sigmas);
  if (!better) return narrow;
  return {.match = task.Match(better, predicted), .score = better->score};
}

bool IsAsExpected(const MatchResult& match, const UncertainPose2& expected) {
  return SquaredMahalanobisDistance(expected, match.pose()) < kSlippedChi2;
}

}  // namespace

MatchResult ScanLocator::Locate(const ScanMap& map,
                                std::span<const ScanPoint> points,
                                const UncertainPose2& predicted,
                                const FreeSpace& seen_free) const {
  const Task task = TaskOf(options_, matcher_, map, points, predicted, seen_free);
  const ScoredMatch near = LocateIn(task, predicted);
  if (task.Fits(near.match, options_.widen_below_overlap)) return near.match;

  const UncertainPose2 inflated = predicted.Inflated(options_.widen_factor);
  // No pose scores less when the prediction counts less: the best one scores as much, or more.
  constexpr double kRounding = 1e-9;
  const double known_score = std::max(0.0, near.score - kRounding);
  const auto wider = task.Search(inflated, options_.window_sigmas, known_score);
  const MatchResult wide = task.Match(wider, inflated);
  return wide.overlap > near.match.overlap + options_.widen_gain ? wide : near.match;
}

MatchResult ScanLocator::LocateWithin(const ScanMap& map,
                                      std::span<const ScanPoint> points,
                                      const UncertainPose2& predicted,
                                      double least_explained,
                                      const FreeSpace& seen_free) const {
  const Task task = TaskOf(options_, matcher_, map, points, predicted, seen_free);
  return LocateIn(task, predicted, kLeastScore * least_explained).match;
}

MatchResult ScanLocator::Locate(const ScanMap& map,
                                std::span<const ScanPoint> points,
                                const PosePrediction& predicted,
                                const FreeSpace& seen_free) const {
  const MatchResult as_proved = Locate(map, points, predicted.adapted, seen_free);
  const bool is_as_proved = IsAsExpected(as_proved, predicted.adapted);
  if (is_as_proved && as_proved.overlap >= options_.confident_overlap) return as_proved;
  const MatchResult slipped = Locate(map, points, predicted.conservative, seen_free);
  const double told = PlaceEvidence::ToldBySurfaces(points);
  if (!is_as_proved) {
    const PlaceFit elsewhere{.told = told,
                             .explained = std::max(as_proved.overlap, slipped.overlap)};
    const auto stands = LocateByWhatStands(map, points, predicted.adapted, elsewhere, seen_free);
    if (stands) return *stands;
  }
  const double lead = LeadInNats(told, slipped.overlap, as_proved.overlap);
  const bool has_slipped = lead >= (is_as_proved ? kSlipNats : 0.0);
  return has_slipped ? slipped : as_proved;
}

// Somebody who walks before the robot takes the match along, where the walls let him. Where the
// robot is expected nearly all agrees that does so elsewhere, and the rest is he.
// @param elsewhere how much of the scan agrees there.
std::optional<MatchResult> ScanLocator::LocateByWhatStands(const ScanMap& map,
                                                           std::span<const ScanPoint> points,
                                                           const UncertainPose2& expected,
                                                           const PlaceFit& elsewhere,
                                                           const FreeSpace& seen_free) const {
  const PointsThatAgree stands = PlaceEvidence::PointsOnSurfaces(map, points, expected.T_a_b);
  const double least_share = (1.0 - seen_free.options().max_moving_share) * elsewhere.explained;
  if (stands.share < least_share) return std::nullopt;
  if (LeadInNats(elsewhere.told, elsewhere.explained, stands.share) >= kSlipNats) {
    return std::nullopt;
  }
  MatchResult match = Locate(map, stands.points, expected, seen_free);
  match.overlap *= stands.share;
  if (!HasMatched(match) || !IsAsExpected(match, expected)) return std::nullopt;
  return match;
}

}  // namespace qwsm
