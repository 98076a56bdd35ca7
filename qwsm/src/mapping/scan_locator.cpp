// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_locator.hpp"

#include <algorithm>
#include <cmath>
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

// A match, and the pose that it began from, if a search found one.
struct BegunMatch {
  MatchResult match;
  std::optional<FoundPose> begun;
  double score = 0.0;  // Of that pose.
};

// One scan to be located.
struct Task {
  const ScanLocatorOptions& options;
  const WeightedScanMatcher& matcher;
  const SurfaceMap& map;
  std::span<const ScanPoint> points;
  std::vector<Eigen::Vector2d> thinned;
  const FreeSpace& seen_free;
  double least_score;  // Poses that score no better are not found.

  // The best pose within so many sigmas of where it is expected, if it scores more than that.
  // @param searched_sigmas within so many no pose scores more.
  std::optional<FoundPose> Search(const UncertainPose2& expected,
                                  double sigmas,
                                  double min_score,
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
  BegunMatch Match(const std::optional<FoundPose>& found, const UncertainPose2& expected) const {
    MatchPrior prior{.predicted = expected,
                     .start = expected.T_a_b,
                     .start_error = {.translation_m = expected.SigmaXY_m(),
                                     .rotation_rad = expected.SigmaTheta_rad()}};
    if (found) {
      prior.start = found->T_map_robot;
      prior.start_error = {.translation_m = options.search_error_m};
    }
    return {.match = matcher.Match(map, seen_free.WithoutMoving(points, prior.start), prior),
            .begun = found,
            .score = found ? found->score : least_score};
  }

  // Whether a match began from there or ended there, as exactly as searches find poses.
  bool IsPlaceOf(const BegunMatch& begun, const Pose2& T_map_robot) const {
    const auto is_same = [&](const Pose2& other) {
      const double apart_m = 3.0 * options.search_error_m;
      const Eigen::Vector3d difference = Difference(T_map_robot, other);
      return difference.head<2>().norm() < apart_m &&
             std::abs(difference.z()) * options.search.lever_m < apart_m;
    };
    return is_same(begun.match.T_ref_cur) || (begun.begun && is_same(begun.begun->T_map_robot));
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
            const FreeSpace& seen_free,
            double least_explained = 0.0) {
  return {.options = options,
          .matcher = matcher,
          .map = map.surfaces(),
          .points = points,
          .thinned = PositionsOf(
              seen_free.WithoutMoving(ThinOut(points, options.search_spacing_m), predicted.T_a_b)),
          .seen_free = seen_free,
          .least_score = kLeastScore * least_explained};
}

// Within the window of the prediction: in the middle first, where it mostly is. What is not likely
// there is matched only if the whole window has nothing better.
// @return nothing if a score is asked for that no pose has
std::optional<BegunMatch> LocateIn(const Task& task, const UncertainPose2& predicted) {
  const double sigmas = task.options.window_sigmas;
  const double narrow_sigmas = task.options.narrow_share * sigmas;
  const auto near = task.Search(predicted, narrow_sigmas, task.least_score);
  const double near_score = near ? near->score : task.least_score;
  std::optional<BegunMatch> matched;
  if (near && near_score >= task.options.confident_score) {
    matched = task.Match(near, predicted);
    if (task.Fits(matched->match, task.options.confident_overlap)) return matched;
  }
  if (const auto better = task.Search(predicted, sigmas, near_score, narrow_sigmas)) {
    return task.Match(better, predicted);
  }
  if (!near && task.least_score > 0.0) return std::nullopt;
  return matched ? matched : task.Match(near, predicted);
}

// The pose that scores most, if it is another place than the one known and explains so much more
// of the scan.
// @param score_gain by so much more it has to score.
std::optional<BegunMatch> LocateBetter(const Task& task,
                                       const UncertainPose2& predicted,
                                       const std::optional<BegunMatch>& known,
                                       double gain,
                                       double score_gain) {
  const double least_score = known ? known->score + score_gain : task.least_score;
  const auto found = task.Search(predicted, task.options.window_sigmas, least_score);
  if (!found || (known && task.IsPlaceOf(*known, found->T_map_robot))) return std::nullopt;
  const BegunMatch better = task.Match(found, predicted);
  if (known && better.match.overlap <= known->match.overlap + gain) return std::nullopt;
  return better;
}

// The same in a wider window.
std::optional<BegunMatch> LocateWider(const Task& task,
                                      const UncertainPose2& predicted,
                                      const std::optional<BegunMatch>& known,
                                      double gain = 0.0) {
  const UncertainPose2 inflated = predicted.Inflated(task.options.widen_factor);
  const double widen_gain = task.options.widen_gain;
  return LocateBetter(task, inflated, known, std::max(gain, widen_gain), kLeastScore * widen_gain);
}

// Within the window, and wider where little of the scan is explained or it fits badly.
std::optional<BegunMatch> LocateAround(const Task& task, const UncertainPose2& predicted) {
  const auto near = LocateIn(task, predicted);
  if (near && task.Fits(near->match, task.options.widen_below_overlap)) return near;
  const auto better = LocateWider(task, predicted, near);
  return better ? better : near;
}

// Where the robot is if its wheels have slipped: that it explains more of the scan has to tell.
std::optional<BegunMatch> LocateSlipped(const Task& task,
                                        const UncertainPose2& predicted,
                                        const BegunMatch& as_proved,
                                        double told) {
  const double gain = ShareForLead(told, kSlipNats);
  const auto slipped = LocateBetter(task, predicted, as_proved, gain, 0.0);
  const BegunMatch& best = slipped ? *slipped : as_proved;
  if (task.Fits(best.match, task.options.widen_below_overlap)) return slipped;
  const auto wider = LocateWider(task, predicted, best, gain);
  return wider ? wider : slipped;
}

std::optional<MatchResult> MatchOf(const std::optional<BegunMatch>& begun) {
  return begun ? std::optional(begun->match) : std::nullopt;
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
  return LocateAround(task, predicted)->match;
}

std::optional<MatchResult> ScanLocator::LocateExplaining(const ScanMap& map,
                                                         std::span<const ScanPoint> points,
                                                         const UncertainPose2& predicted,
                                                         double least_explained,
                                                         const FreeSpace& seen_free) const {
  const Task task = TaskOf(options_, matcher_, map, points, predicted, seen_free, least_explained);
  return MatchOf(LocateAround(task, predicted));
}

std::optional<MatchResult> ScanLocator::LocateWithin(const ScanMap& map,
                                                     std::span<const ScanPoint> points,
                                                     const UncertainPose2& predicted,
                                                     double least_explained,
                                                     const FreeSpace& seen_free) const {
  const Task task = TaskOf(options_, matcher_, map, points, predicted, seen_free, least_explained);
  return MatchOf(LocateIn(task, predicted));
}

MatchResult ScanLocator::Locate(const ScanMap& map,
                                std::span<const ScanPoint> points,
                                const PosePrediction& predicted,
                                const FreeSpace& seen_free) const {
  const auto task_of = [&](const UncertainPose2& expected) {
    return TaskOf(options_, matcher_, map, points, expected, seen_free);
  };
  const BegunMatch first = *LocateAround(task_of(predicted.adapted), predicted.adapted);
  const MatchResult& as_proved = first.match;
  const bool is_as_proved = IsAsExpected(as_proved, predicted.adapted);
  if (is_as_proved && as_proved.overlap >= options_.confident_overlap) return as_proved;

  const Task task = task_of(predicted.conservative);
  const double told = PlaceEvidence::ToldBySurfaces(points);
  if (is_as_proved) {
    const auto slipped = LocateSlipped(task, predicted.conservative, first, told);
    return slipped ? slipped->match : as_proved;
  }
  const MatchResult slipped = LocateAround(task, predicted.conservative)->match;
  const PlaceFit elsewhere{.told = told, .explained = std::max(as_proved.overlap, slipped.overlap)};
  const auto stands = LocateByWhatStands(map, points, predicted.adapted, elsewhere, seen_free);
  if (stands) return *stands;
  return slipped.overlap >= as_proved.overlap ? slipped : as_proved;
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
