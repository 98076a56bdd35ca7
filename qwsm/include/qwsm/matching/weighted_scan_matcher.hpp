// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "qwsm/matching/match_result.hpp"
#include "qwsm/matching/surface_map.hpp"
#include "qwsm/sensor/range_noise.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Says by what pairs are weighted.
enum class PairWeighting {
  kModelled,  ///< Each counts by the inverse of its modelled errors (Pfister et al. 2002).
  kIdentity,  ///< All count the same: plain point-to-point ICP.
};

/// Says which points of a scan count.
enum class PairSelection {
  kEveryPoint,  ///< Each with the stored point nearest to it.
  /// Of successive points with the same stored one only the nearest, and none beyond the end of
  /// what is stored (Turk & Levoy 1994): all of these share the error of that end.
  kOneToOne,
};

/// Says how wide what lies around both points of a pair is looked at, where it is no straight line.
enum class PairComparison {
  kWide,  ///< The mean of all that is stored around, with that of the scan where it is of a line.
  /// Means within half the reach: where a surface curves, bends or ends they lie less far aside.
  kNear,
};

struct WeightedScanMatcherOptions {
  RangeNoise noise;
  PairWeighting weighting = PairWeighting::kModelled;
  PairSelection selection = PairSelection::kEveryPoint;
  PairComparison comparison = PairComparison::kWide;
  int max_iterations = 30;
  double translation_tolerance_m = 0.002;
  double rotation_tolerance_rad = 0.0007;
  double pair_distance_m = 0.15;
  double annealing_factor = 0.3;
  double outlier_sigmas = 5.0;
  double small_object_m = 0.02;
  double correlated_points = 3.0;
  double min_information_ratio = 0.006;
  int min_pairs = 1;
  double max_sigma_m = 2.0;
  double min_overlap = 0.35;
  double max_prior_sigmas = 8.0;
};

template <class Visitor>
void Describe(Visitor& visit, WeightedScanMatcherOptions& o) {
  visit("noise", o.noise, {.help = "the laser's errors"});
  visit("max_iterations",
        o.max_iterations,
        {.help = "upper bound on iterations", .min = 1, .max = 1000});
  visit("translation_tolerance_m",
        o.translation_tolerance_m,
        {.help = "converged when a step is shorter", .min = 1e-9, .max = 0.1});
  visit("rotation_tolerance_rad",
        o.rotation_tolerance_rad,
        {.help = "converged when a step turns less", .min = 1e-9, .max = 0.1});
  visit("pair_distance_m",
        o.pair_distance_m,
        {.help = "in the end, points further apart are no pair", .min = 0.02, .max = 10});
  visit(
      "annealing_factor",
      o.annealing_factor,
      {.help = "per iteration, what is left of the first guess's error by which pairs are inflated",
       .min = 0.05,
       .max = 0.95});
  visit("outlier_sigmas",
        o.outlier_sigmas,
        {.help = "a pair this far off counts a quarter", .min = 0.5, .max = 100});
  visit("small_object_m",
        o.small_object_m,
        {.help = "extent of what is no line: a leg, a trunk, a corner", .min = 0, .max = 1});
  visit(
      "correlated_points",
      o.correlated_points,
      {.help = "how many pairs say as much as one with independent errors", .min = 1, .max = 1000});
  visit("min_information_ratio",
        o.min_information_ratio,
        {.help = "a direction of which the pairs tell less than this share is left to the prior",
         .formerly = "min_information_share",
         .min = 0,
         .max = 1});
  visit("min_pairs", o.min_pairs, {.help = "fewer pairs are no match", .min = 1, .max = 100});
  visit("max_sigma_m",
        o.max_sigma_m,
        {.help = "a position less certain than this is no match", .min = 0.01, .max = 100});
  visit(
      "min_overlap",
      o.min_overlap,
      {.help = "a match is inconsistent if less of the scan agrees with it", .min = 0, .max = 0.9});
  visit("max_prior_sigmas",
        o.max_prior_sigmas,
        {.help = "a match is inconsistent if it is more sigmas away from the prediction",
         .min = 1,
         .max = 1000});
}

/// Standard deviations of a first guess.
struct StartError {
  double translation_m = 0.1;
  double rotation_rad = 0.0;
};

/// What is known of a pose before the match.
struct MatchPrior {
  UncertainPose2 predicted;  ///< Prediction of T_ref_cur; it is fused into the answer.
  Pose2 start;               ///< First guess: the prediction, or what a search found near it.
  StartError start_error;    ///< How far off the start may be; pairs are sought five times as far.
  /// Stored points that drifted more are not paired.
  double max_drift_m2 = std::numeric_limits<double>::infinity();
};

/// Weighted scan matching (Pfister et al. 2002; Visser et al. 2009) of a scan against a map of
/// surfaces: that of all relevant scans makes it Q-WSM, that of the last one WSM.
///
/// Departing from the papers, (x, y, theta) are solved for together, with a prior; a pair counts
/// less the worse it fits; and along a line a pair says nothing. There the papers' nearest sample
/// is never further than half a sample spacing, so that a corridor would look well determined.
class WeightedScanMatcher {
 public:
  explicit WeightedScanMatcher(const WeightedScanMatcherOptions& options = {})
      : options_(options) {}

  /// Matches the points of a scan with the surfaces of the reference.
  /// @param trace if given, gets one entry per iteration.
  MatchResult Match(const SurfaceMap& reference,
                    std::span<const ScanPoint> points,
                    const MatchPrior& prior,
                    MatchTrace* trace = nullptr) const;

  const WeightedScanMatcherOptions& options() const { return options_; }

 private:
  WeightedScanMatcherOptions options_;
};

}  // namespace qwsm
