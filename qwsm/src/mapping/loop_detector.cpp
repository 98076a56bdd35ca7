// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/loop_detector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace qwsm {
namespace {

constexpr std::size_t kMinPoints = 20;  // A loop closure needs evidence.
constexpr double kSamePlace_m = 0.3;    // Candidates this near to each other are no rivals.
constexpr double kSamePose_m = 0.1;     // Matches that end this near to each other agree.
constexpr double kRivalOverlap = 0.8;   // A rival with less than this share of the overlap is none.
// Ratio of the least to the most information about the position, below which a submap does not tell
// it. Along walls alone it is a hundredth.
constexpr double kMinSubmapRatio = 0.1;
// A match must leave at most this share of the estimate's sigma: else it says too little.
constexpr double kMaxSigmaShare = 0.5;

double Distance_m(const Pose2& a, const Pose2& b) {
  return (a.translation_m() - b.translation_m()).norm();
}

// A candidate is as exact as the search that found it.
constexpr double kCandidateSigma_m = 0.1;
constexpr double kCandidateSigma_rad = 0.02;
UncertainPose2 CandidateAt(const Pose2& pose) {
  return UncertainPose2::WithSigmas(pose, kCandidateSigma_m, kCandidateSigma_rad);
}

// How wrong the scans of a submap lie to one another.
Eigen::Matrix3d CovarianceWithinSubmap() {
  return UncertainPose2::WithSigmas({}, 0.05, 0.01).covariance;
}

// Ratio of the information about the position along its weakest and its strongest direction, were
// the heading known.
double InformationRatioWithHeadingGiven(const Eigen::Matrix3d& information) {
  Eigen::Matrix3d of_position = information;
  of_position.topRightCorner<2, 1>().setZero();
  return DegeneracyOf(of_position).ratio();
}

// What of a submap lies where surfaces with little drift were mapped before.
struct Revisit {
  double share = 0.0;          // Of the submap's points.
  double mean_drift_m2 = 0.0;  // Of these surfaces.
};

// The smallest drift of what is mapped within reach of positions. Many of them lie in one cell:
// what was found for it is kept.
class DriftAround {
 public:
  DriftAround(const LikelihoodPyramid& map, double reach_m) : map_(map) {
    const double cells = reach_m / ((1 << kShift) * map.cell_size_m());
    reach_ = std::max(1, static_cast<int>(std::ceil(cells)));
  }

  std::uint8_t Smallest(const Eigen::Vector2d& p_map) {
    const GridCell finest = map_.CellAt(p_map);
    const GridCell cell{finest.x >> kShift, finest.y >> kShift};
    const int place = (cell.y & kMask) * (kMask + 1) + (cell.x & kMask);
    Known& known = known_[static_cast<std::size_t>(place)];
    if (!known.is_known || known.cell != cell) {
      known = {
          .cell = cell, .is_known = true, .code = map_.SmallestDriftCode(kLevel, finest, reach_)};
    }
    return known.code;
  }

 private:
  static constexpr int kLevel = LikelihoodPyramid::kLevels - 1;
  static constexpr int kShift = LikelihoodTile::DriftShiftOf(kLevel);
  static constexpr int kMask = 7;
  struct Known {
    GridCell cell;
    bool is_known = false;
    std::uint8_t code = 0;
  };

  const LikelihoodPyramid& map_;
  int reach_;
  std::array<Known, (kMask + 1) * (kMask + 1)> known_{};
};

// @param reach_m how far the points may be off.
// @param max_drift_m2 surfaces that drifted more do not count.
Revisit RevisitOf(const LikelihoodPyramid& map,
                  std::span<const ScanPoint> submap,
                  const Pose2& T_map_robot,
                  double reach_m,
                  double max_drift_m2) {
  const std::uint8_t max_code = LikelihoodPyramid::DriftCode(max_drift_m2);
  const RigidTransform2 to_map(T_map_robot);
  DriftAround drift(map, reach_m);
  Revisit revisit;
  int count = 0;
  for (const ScanPoint& point : submap) {
    const std::uint8_t code = drift.Smallest(to_map * point.p_robot_m);
    if (code > max_code) continue;
    ++count;
    revisit.mean_drift_m2 += LikelihoodPyramid::DriftOf(code);
  }
  if (count > 0) revisit.mean_drift_m2 /= count;
  revisit.share = static_cast<double>(count) / static_cast<double>(submap.size());
  return revisit;
}

// One scan that may close a loop.
struct Attempt {
  const ScanLocatorOptions& options;
  const WeightedScanMatcher& matcher;
  const SurfaceMap& map;
  std::span<const ScanPoint> points;
  std::span<const ScanPoint> submap;
  const UncertainPose2& estimated;
  double max_drift_m2;  // Of the surfaces that a loop is closed with.

  // The pose at which the submap fits best, and others, near and far, at which it fits nearly as
  // well. None if it fits best where the robot is estimated anyway.
  std::vector<Pose2> CandidatesWithin(double drift_m) const {
    const LoopClosureOptions& closure = options.loop_closure;
    const std::vector<Eigen::Vector2d> submap_robot_m = PositionsOf(submap);
    const UncertainPose2 inflated = estimated.Inflated(closure.sigma_inflation);
    const SearchWindow window{
        .predicted = inflated,
        .translation_m = std::min(closure.max_window_m, closure.window_sigmas * drift_m),
        .rotation_rad =
            std::min(closure.max_window_rad, closure.window_sigmas * inflated.SigmaTheta_rad()),
        .max_drift_code = LikelihoodPyramid::DriftCode(max_drift_m2)};
    PoseSearch search(map.likelihood(), submap_robot_m, window, closure.search);
    const auto best = search.Best(closure.min_score);
    if (!best) return {};
    if (Distance_m(estimated.T_a_b, best->T_map_robot) < kSamePlace_m) return {};
    std::vector<Pose2> candidates = {best->T_map_robot};
    const double rival_score = best->score - closure.uniqueness;
    ExcludedDisk around_best{.center_map_m = best->T_map_robot.translation_m()};
    // About a single clump of trees many poses next to one another fit; another clump is further
    // away.
    for (double apart_m = kSamePlace_m; apart_m < 2.0 * window.translation_m; apart_m *= 2.0) {
      around_best.radius_m = apart_m;
      const auto rival = search.Best(rival_score, around_best);
      if (!rival) break;
      candidates.push_back(rival->T_map_robot);
    }
    return candidates;
  }

  MatchPrior PriorOf(const UncertainPose2& expected, const Pose2& start) const {
    return {.predicted = expected,
            .start = start,
            .start_error = {.translation_m = options.search_error_m},
            .max_drift_m2 = max_drift_m2};
  }

  // A single clump of trees tells the position around it and the heading only together. Whether it
  // tells anything is asked with the heading given, so that no direction is removed here.
  MatchResult MatchSubmap(const Pose2& start) const {
    WeightedScanMatcherOptions all_directions = matcher.options();
    all_directions.min_information_ratio = 0.0;
    return WeightedScanMatcher(all_directions).Match(map, submap, PriorOf(estimated, start));
  }

  // The scan matched where it is expected, if it fits there.
  std::optional<MatchResult> Fitting(const UncertainPose2& expected) const {
    const MatchResult match = matcher.Match(map, points, PriorOf(expected, expected.T_a_b));
    const bool fits = match.status == MatchStatus::kConverged &&
                      match.overlap >= options.loop_closure.min_overlap;
    return fits ? std::optional(match) : std::nullopt;
  }

  // Whether the pairs alone tell better than the search did where along every direction the robot
  // is. As many pairs as one count as one here, too, although their scatter has been measured: a
  // wrong loop closure is worse than none.
  bool IsDeterminedByPairs(const MatchResult& match) const {
    const double weakest = DegeneracyOf(match.pair_information).weakest_information;
    return options.matcher.correlated_points < weakest * kCandidateSigma_m * kCandidateSigma_m;
  }

  // Where the submap leads once the estimate has its say: a few trees far ahead leave open how the
  // robot is turned and with it where it stands, and only the estimate can tell. From all
  // candidates it must be the same pose, unless they turn out not to fit there. How far along a
  // corridor it is, the estimate cannot tell.
  std::optional<UncertainPose2> AgreedFrom(std::span<const Pose2> candidates) const {
    const MatchResult best = MatchSubmap(candidates.front());
    UncertainPose2 agreed = best.pose();
    if (best.status != MatchStatus::kConverged ||
        InformationRatioWithHeadingGiven(best.pair_information) < kMinSubmapRatio ||
        agreed.SigmaXY_m() > kMaxSigmaShare * estimated.SigmaXY_m() ||
        Distance_m(agreed.T_a_b, estimated.T_a_b) < kSamePose_m) {
      return std::nullopt;
    }
    for (const Pose2& rival : candidates.subspan(1)) {
      const MatchResult other = MatchSubmap(rival);
      const bool fits =
          other.status == MatchStatus::kConverged && other.overlap >= kRivalOverlap * best.overlap;
      if (fits && Distance_m(best.T_ref_cur, other.T_ref_cur) > kSamePose_m) return std::nullopt;
    }
    agreed.covariance += CovarianceWithinSubmap();
    return agreed;
  }

  std::optional<MatchResult> MatchAtOneOf(std::span<const Pose2> candidates) const {
    if (candidates.empty()) return std::nullopt;
    if (candidates.size() == 1) {
      const auto there = Fitting(CandidateAt(candidates.front()));
      if (there && IsDeterminedByPairs(*there)) return there;
    }
    const auto agreed = AgreedFrom(candidates);
    return agreed ? Fitting(*agreed) : std::nullopt;
  }
};

}  // namespace

std::optional<ClosedLoop> LoopDetector::Detect(const ScanMap& map,
                                               std::span<const ScanPoint> points,
                                               std::span<const ScanPoint> submap,
                                               const UncertainPose2& estimated) const {
  if (submap.size() < kMinPoints) return std::nullopt;
  const LoopClosureOptions& options = options_.loop_closure;
  const double drift_m = estimated.SigmaXY_m();
  const double max_drift_m2 = options.max_drift_share * drift_m * drift_m;
  const Revisit revisit =
      RevisitOf(map.surfaces().likelihood(),
                submap,
                estimated.T_a_b,
                std::min(options.max_window_m, options.sigma_inflation * drift_m),
                max_drift_m2);
  const double drift_since_m =
      options.sigma_inflation * std::sqrt(std::max(0.0, drift_m * drift_m - revisit.mean_drift_m2));
  if (revisit.share < options.min_revisited_share || drift_since_m < options.min_drift_m) {
    return std::nullopt;
  }
  const Attempt attempt{.options = options_,
                        .matcher = matcher_,
                        .map = map.surfaces(),
                        .points = points,
                        .submap = submap,
                        .estimated = estimated,
                        .max_drift_m2 = max_drift_m2};
  const auto match = attempt.MatchAtOneOf(attempt.CandidatesWithin(drift_since_m));
  if (!match) return std::nullopt;
  UncertainPose2 map_robot = match->pose();
  const FrameCovariance of_map = map.CovarianceUnder(points, map_robot.T_a_b, max_drift_m2);
  map_robot.covariance += of_map.At(map_robot.T_a_b.translation_m());
  return ClosedLoop{.match = *match, .map_robot = map_robot};
}

}  // namespace qwsm
