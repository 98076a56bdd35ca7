// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_locator.hpp"

#include <algorithm>
#include <cmath>

namespace qwsm {
namespace {

constexpr std::size_t kMinSearchPoints = 2;   // One fits anywhere.
constexpr std::size_t kMinReturnPoints = 20;  // A return needs more evidence.
constexpr double kSamePlace_m = 0.3;          // Poses this near to each other are no rivals.
constexpr double kFoundSigma_m = 0.1;         // How exact a search over many scans is.
constexpr double kFoundSigma_rad = 0.02;

double SigmaXY(const Eigen::Matrix3d& covariance) {
  return std::sqrt(0.5 * (covariance(0, 0) + covariance(1, 1)));
}
double SigmaTheta(const Eigen::Matrix3d& covariance) { return std::sqrt(covariance(2, 2)); }

// What of the map around a scan was mapped with little drift.
struct KnownSurroundings {
  double share = 0.0;          // Of the points that end near such surfaces.
  double mean_drift_m2 = 0.0;  // Of these surfaces.
};

// The smallest drift of what is mapped within reach of a position.
std::uint8_t SmallestDriftAround(const LikelihoodPyramid& map,
                                 const Eigen::Vector2d& p_map,
                                 double reach_m) {
  constexpr int kLevel = LikelihoodPyramid::kLevels - 1;
  constexpr int kStride = 1 << kLevel;
  const double cells = reach_m / (kStride * map.cell_size_m());
  const int reach = kStride * std::max(1, static_cast<int>(std::lround(cells)));
  std::uint8_t smallest = LikelihoodPyramid::kUnmapped;
  for (int dy = -reach; dy <= reach; dy += kStride) {
    for (int dx = -reach; dx <= reach; dx += kStride) {
      smallest = std::min(
          smallest,
          map.DriftCodeAt(kLevel, map.CellIndex(p_map.x()) + dx, map.CellIndex(p_map.y()) + dy));
    }
  }
  return smallest;
}

// @param reach_m how far the points may be off.
KnownSurroundings SurroundingsOf(const LikelihoodPyramid& map,
                                 std::span<const Eigen::Vector2d> points_robot_m,
                                 const Pose2& T_map_robot,
                                 double reach_m,
                                 double max_drift_m2) {
  const std::uint8_t max_code = LikelihoodPyramid::DriftCode(max_drift_m2);
  KnownSurroundings known;
  int count = 0;
  for (const Eigen::Vector2d& p_robot : points_robot_m) {
    const std::uint8_t code = SmallestDriftAround(map, T_map_robot * p_robot, reach_m);
    if (code > max_code) continue;
    ++count;
    known.mean_drift_m2 += LikelihoodPyramid::DriftOf(code);
  }
  if (count > 0) known.mean_drift_m2 /= count;
  known.share = static_cast<double>(count) / static_cast<double>(points_robot_m.size());
  return known;
}

UncertainPose2 Widened(const UncertainPose2& pose, double factor) {
  return {.T_a_b = pose.T_a_b, .covariance = factor * factor * pose.covariance};
}

// One scan to be located.
struct Task {
  const ScanLocatorOptions& options;
  const WeightedScanMatcher& matcher;
  const SurfaceMap& map;
  std::span<const ScanPoint> points;
  std::vector<Eigen::Vector2d> thinned;
  const FreeSpace& seen_free;

  // The best pose within so many sigmas of where it is expected, if it scores more than that.
  std::optional<FoundPose> Search(const UncertainPose2& expected,
                                  double sigmas,
                                  double min_score = 0.0) const {
    if (thinned.size() < kMinSearchPoints) return std::nullopt;
    const Eigen::Matrix3d& covariance = expected.covariance;
    return SearchPose(
        map.likelihood(),
        thinned,
        {.predicted = expected,
         .translation_m = std::min(options.max_window_m, sigmas * SigmaXY(covariance)),
         .rotation_rad = std::min(options.max_window_rad, sigmas * SigmaTheta(covariance)),
         .min_score = min_score},
        options.search);
  }

  // Matches what has not moved from the pose found, or from where it is expected.
  MatchResult Match(const std::optional<FoundPose>& found, const UncertainPose2& expected) const {
    MatchPrior prior{.predicted = expected,
                     .start = expected.T_a_b,
                     .start_error = {.translation_m = SigmaXY(expected.covariance),
                                     .rotation_rad = SigmaTheta(expected.covariance)}};
    if (found) {
      prior.start = found->T_map_robot;
      prior.start_error = {.translation_m = options.search_error_m};
    }
    return matcher.Match(map, seen_free.WithoutMoving(points, prior.start), prior);
  }
};

}  // namespace

MatchResult ScanLocator::Locate(const ScanMap& map,
                                std::span<const ScanPoint> points,
                                const UncertainPose2& predicted,
                                const FreeSpace& seen_free) const {
  const Task task{.options = options_,
                  .matcher = matcher_,
                  .map = map.surfaces(),
                  .points = points,
                  .thinned = ThinOut(seen_free.WithoutMoving(points, predicted.T_a_b),
                                     options_.search_spacing_m),
                  .seen_free = seen_free};
  const double sigmas = options_.window_sigmas;

  const auto near = task.Search(predicted, options_.narrow_share * sigmas);
  const MatchResult narrow = task.Match(near, predicted);
  if (narrow.overlap >= options_.confident_overlap) return narrow;

  const auto better = task.Search(predicted, sigmas, near ? near->score : 0.0);
  const MatchResult full = better ? task.Match(better, predicted) : narrow;
  if (full.overlap >= options_.widen_below_overlap) return full;

  const UncertainPose2 doubted = Widened(predicted, options_.widen_factor);
  const MatchResult wide = task.Match(task.Search(doubted, sigmas), doubted);
  return wide.overlap > full.overlap + options_.widen_gain ? wide : full;
}

// Whether the pairs alone tell where along every direction the robot is, not what was searched.
bool ScanLocator::IsHeldByPairs(const MatchResult& match) const {
  const double weakest = HoldOf(match.information).weakest_information;
  return options_.matcher.correlated_points < weakest * kFoundSigma_m * kFoundSigma_m;
}

std::optional<MatchResult> ScanLocator::FindReturn(
    const ScanMap& map,
    std::span<const ScanPoint> points,
    std::span<const Eigen::Vector2d> surroundings_robot_m,
    const UncertainPose2& estimated) const {
  if (surroundings_robot_m.size() < kMinReturnPoints) return std::nullopt;
  const ReturnOptions& options = options_.known_places;
  const LikelihoodPyramid& likelihood = map.surfaces().likelihood();
  const UncertainPose2 doubted = Widened(estimated, options.caution);
  const double drift_m2 = std::pow(SigmaXY(estimated.covariance), 2);
  const double max_drift_m2 = options.max_drift_share * drift_m2;
  const double reach_m =
      std::min(options.max_window_m, options.caution * SigmaXY(estimated.covariance));
  const KnownSurroundings known =
      SurroundingsOf(likelihood, surroundings_robot_m, estimated.T_a_b, reach_m, max_drift_m2);
  const double drift_since_m =
      options.caution * std::sqrt(std::max(0.0, drift_m2 - known.mean_drift_m2));
  if (known.share < options.min_known_share || drift_since_m < options.min_drift_m) {
    return std::nullopt;
  }
  const auto place = OnlyPlace(
      likelihood,
      surroundings_robot_m,
      {.predicted = doubted,
       .translation_m = std::min(options.max_window_m, options.window_sigmas * drift_since_m),
       .rotation_rad =
           std::min(options.max_window_rad, options.window_sigmas * SigmaTheta(doubted.covariance)),
       .min_score = options.min_score,
       .max_drift_code = LikelihoodPyramid::DriftCode(max_drift_m2)});
  if (!place) return std::nullopt;

  UncertainPose2 found{.T_a_b = *place};
  found.covariance.diagonal() =
      Eigen::Vector3d(kFoundSigma_m, kFoundSigma_m, kFoundSigma_rad).cwiseAbs2();
  const MatchResult match =
      matcher_.Match(map.surfaces(),
                     points,
                     {.predicted = found,
                      .start = found.T_a_b,
                      .start_error = {.translation_m = options_.search_error_m},
                      .max_drift_m2 = max_drift_m2});
  const bool fits = match.status == MatchStatus::kConverged && match.overlap >= options.min_overlap;
  return fits && IsHeldByPairs(match) ? std::optional(match) : std::nullopt;
}

// The place that fits best, unless another one fits nearly as well or it is where we are anyway.
std::optional<Pose2> ScanLocator::OnlyPlace(const LikelihoodPyramid& map,
                                            std::span<const Eigen::Vector2d> surroundings_robot_m,
                                            SearchWindow window) const {
  const ReturnOptions& options = options_.known_places;
  const auto best = SearchPose(map, surroundings_robot_m, window, options.search);
  if (!best) return std::nullopt;
  const Pose2 jump = window.predicted.T_a_b.Inverse() * best->T_map_robot;
  if (jump.translation_m().norm() < kSamePlace_m) return std::nullopt;
  window.exclude = best->T_map_robot;
  window.exclude_m = kSamePlace_m;
  window.min_score = best->score - options.uniqueness;
  const auto rival = SearchPose(map, surroundings_robot_m, window, options.search);
  return rival ? std::nullopt : std::optional(best->T_map_robot);
}

}  // namespace qwsm
