// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/return_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace qwsm {
namespace {

constexpr std::size_t kMinPoints = 20;  // A return needs evidence.
constexpr double kSamePlace_m = 0.3;    // Places this near to each other are no rivals.
constexpr double kSamePose_m = 0.1;     // Matches that end this near to each other agree.
constexpr double kNearlyAsGood = 0.8;   // A rival with less than this share of the overlap is none.
constexpr double kMinHold = 0.1;        // Along walls alone it is a hundredth.
constexpr double kDecided = 0.5;        // What a match leaves of the estimate's sigma, at most.

double Distance_m(const Pose2& a, const Pose2& b) {
  return (a.translation_m() - b.translation_m()).norm();
}

// A place found by a search over many scans, as exact as such a search is.
constexpr double kFoundSigma_m = 0.1;
UncertainPose2 FoundAt(const Pose2& place) {
  return UncertainPose2::WithSigmas(place, kFoundSigma_m, 0.02);
}

// How wrong recent scans lie to one another.
Eigen::Matrix3d CovarianceOfSurroundings() {
  return UncertainPose2::WithSigmas({}, 0.05, 0.01).covariance;
}

// The least of what pairs say of the position in any direction, beside the most, were the heading
// known.
double HoldWithHeadingGiven(const Eigen::Matrix3d& information) {
  Eigen::Matrix3d of_position = information;
  of_position.topRightCorner<2, 1>().setZero();
  return HoldOf(of_position).share();
}

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
  constexpr int kStride = 1 << LikelihoodTile::DriftShiftOf(kLevel);
  const double cells = reach_m / (kStride * map.cell_size_m());
  const int reach = kStride * std::max(1, static_cast<int>(std::lround(cells)));
  const GridCell center = map.CellAt(p_map);
  std::uint8_t smallest = LikelihoodPyramid::kUnmapped;
  for (int dy = -reach; dy <= reach; dy += kStride) {
    for (int dx = -reach; dx <= reach; dx += kStride) {
      smallest = std::min(smallest, map.DriftCodeAt(kLevel, center.x + dx, center.y + dy));
    }
  }
  return smallest;
}

// @param reach_m how far the points may be off.
KnownSurroundings SurroundingsOf(const LikelihoodPyramid& map,
                                 std::span<const ScanPoint> points,
                                 const Pose2& T_map_robot,
                                 double reach_m,
                                 double max_drift_m2) {
  const std::uint8_t max_code = LikelihoodPyramid::DriftCode(max_drift_m2);
  const RigidTransform2 to_map(T_map_robot);
  KnownSurroundings known;
  int count = 0;
  for (const ScanPoint& point : points) {
    const std::uint8_t code = SmallestDriftAround(map, to_map * point.p_robot_m, reach_m);
    if (code > max_code) continue;
    ++count;
    known.mean_drift_m2 += LikelihoodPyramid::DriftOf(code);
  }
  if (count > 0) known.mean_drift_m2 /= count;
  known.share = static_cast<double>(count) / static_cast<double>(points.size());
  return known;
}

// One scan that may be back at a known place.
struct Attempt {
  const ScanLocatorOptions& options;
  const WeightedScanMatcher& matcher;
  const SurfaceMap& map;
  std::span<const ScanPoint> points;
  std::span<const ScanPoint> surroundings;
  const UncertainPose2& estimated;
  double max_drift_m2;  // Of known surfaces.

  // The place where the surroundings fit best, and others, near and far, where they fit nearly as
  // well.
  // None if they fit best where we are anyway.
  std::vector<Pose2> PlacesWithin(double drift_m) const {
    const ReturnOptions& known_places = options.known_places;
    const std::vector<Eigen::Vector2d> surroundings_robot_m = PositionsOf(surroundings);
    const UncertainPose2 doubted = estimated.Widened(known_places.caution);
    SearchWindow window{
        .predicted = doubted,
        .translation_m = std::min(known_places.max_window_m, known_places.window_sigmas * drift_m),
        .rotation_rad = std::min(known_places.max_window_rad,
                                 known_places.window_sigmas * doubted.SigmaTheta_rad()),
        .min_score = known_places.min_score,
        .max_drift_code = LikelihoodPyramid::DriftCode(max_drift_m2)};
    const auto search = [&] {
      return SearchPose(map.likelihood(), surroundings_robot_m, window, known_places.search);
    };
    const auto best = search();
    if (!best) return {};
    if (Distance_m(estimated.T_a_b, best->T_map_robot) < kSamePlace_m) return {};
    std::vector<Pose2> places = {best->T_map_robot};
    window.exclude = best->T_map_robot;
    window.min_score = best->score - known_places.uniqueness;
    // Around a single thicket many places next to one another fit; another thicket is further away.
    for (double apart_m = kSamePlace_m; apart_m < 2.0 * window.translation_m; apart_m *= 2.0) {
      window.exclude_m = apart_m;
      const auto rival = search();
      if (!rival) break;
      places.push_back(rival->T_map_robot);
    }
    return places;
  }

  MatchPrior PriorOf(const UncertainPose2& expected, const Pose2& start) const {
    return {.predicted = expected,
            .start = start,
            .start_error = {.translation_m = options.search_error_m},
            .max_drift_m2 = max_drift_m2};
  }

  // A single thicket holds the way around it and the heading only together. Whether it holds at all
  // is asked with the heading given, so that nothing of it is dropped here.
  MatchResult MatchSurroundings(const Pose2& start) const {
    WeightedScanMatcherOptions undropped = matcher.options();
    undropped.min_information_share = 0.0;
    return WeightedScanMatcher(undropped).Match(map, surroundings, PriorOf(estimated, start));
  }

  // The scan matched where it is expected, if it fits there.
  std::optional<MatchResult> Fitting(const UncertainPose2& expected) const {
    const MatchResult match = matcher.Match(map, points, PriorOf(expected, expected.T_a_b));
    const bool fits = match.status == MatchStatus::kConverged &&
                      match.overlap >= options.known_places.min_overlap;
    return fits ? std::optional(match) : std::nullopt;
  }

  // Whether the pairs alone tell where along every direction the robot is, not what was searched.
  bool IsHeldByPairs(const MatchResult& match) const {
    const double weakest = HoldOf(match.information).weakest_information;
    return options.matcher.correlated_points < weakest * kFoundSigma_m * kFoundSigma_m;
  }

  // Where the surroundings lead once the estimate has its say: a few trees far ahead leave open
  // how the robot is turned and with it where it stands, and only the estimate can tell. From all
  // places it must be the same pose, unless they turn out not to fit there. How far along a
  // corridor it is, the estimate cannot tell.
  std::optional<UncertainPose2> AgreedFrom(std::span<const Pose2> places) const {
    const MatchResult best = MatchSurroundings(places.front());
    UncertainPose2 agreed{.T_a_b = best.T_ref_cur, .covariance = best.covariance};
    if (best.status != MatchStatus::kConverged ||
        HoldWithHeadingGiven(best.information) < kMinHold ||
        agreed.SigmaXY_m() > kDecided * estimated.SigmaXY_m() ||
        Distance_m(agreed.T_a_b, estimated.T_a_b) < kSamePose_m) {
      return std::nullopt;
    }
    for (const Pose2& rival : places.subspan(1)) {
      const MatchResult other = MatchSurroundings(rival);
      const bool fits =
          other.status == MatchStatus::kConverged && other.overlap >= kNearlyAsGood * best.overlap;
      if (fits && Distance_m(best.T_ref_cur, other.T_ref_cur) > kSamePose_m) return std::nullopt;
    }
    agreed.covariance += CovarianceOfSurroundings();
    return agreed;
  }

  std::optional<MatchResult> MatchAtOneOf(std::span<const Pose2> places) const {
    if (places.empty()) return std::nullopt;
    if (places.size() == 1) {
      const auto there = Fitting(FoundAt(places.front()));
      if (there && IsHeldByPairs(*there)) return there;
    }
    const auto agreed = AgreedFrom(places);
    return agreed ? Fitting(*agreed) : std::nullopt;
  }
};

}  // namespace

std::optional<MatchResult> ReturnFinder::Find(const ScanMap& map,
                                              std::span<const ScanPoint> points,
                                              std::span<const ScanPoint> surroundings,
                                              const UncertainPose2& estimated) const {
  if (surroundings.size() < kMinPoints) return std::nullopt;
  const ReturnOptions& options = options_.known_places;
  const double drift_m = estimated.SigmaXY_m();
  const double max_drift_m2 = options.max_drift_share * drift_m * drift_m;
  const KnownSurroundings known =
      SurroundingsOf(map.surfaces().likelihood(),
                     surroundings,
                     estimated.T_a_b,
                     std::min(options.max_window_m, options.caution * drift_m),
                     max_drift_m2);
  const double drift_since_m =
      options.caution * std::sqrt(std::max(0.0, drift_m * drift_m - known.mean_drift_m2));
  if (known.share < options.min_known_share || drift_since_m < options.min_drift_m) {
    return std::nullopt;
  }
  const Attempt attempt{.options = options_,
                        .matcher = matcher_,
                        .map = map.surfaces(),
                        .points = points,
                        .surroundings = surroundings,
                        .estimated = estimated,
                        .max_drift_m2 = max_drift_m2};
  auto back = attempt.MatchAtOneOf(attempt.PlacesWithin(drift_since_m));
  if (back) {
    const Pose2& T_map_robot = back->T_ref_cur;
    back->covariance +=
        map.CovarianceUnder(points, T_map_robot, max_drift_m2).At(T_map_robot.translation_m());
  }
  return back;
}

}  // namespace qwsm
