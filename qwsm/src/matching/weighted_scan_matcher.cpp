// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/weighted_scan_matcher.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "pairing.hpp"

namespace qwsm {
namespace {

constexpr double kPairsOfExpectation = 20.0;  // What the error model is worth beside the pairs.
constexpr int kPairsOfWalls = 40;             // Fewer are no corridor.
constexpr double kMostOfNoise = 4.0;  // Noise of normals passes for up to so many least shares.

// Takes back what pairs seem to say about a direction of which they say next to nothing: normals of
// noisy walls are never quite parallel, and their errors would pass for a hold along a corridor
// (Zhang, Kaess & Singh 2016). Where they may say little, map and scan must agree upon it.
// @return what of (x, y, theta) is held: all, or a projection on the others.
Eigen::Matrix3d DropFalseHold(const Pairing& pairing,
                              const Pose2& T_ref_cur,
                              double min_share,
                              NormalEquations& equations) {
  Eigen::Matrix3d& A = equations.A;
  const PositionHold hold = HoldOf(A);
  const bool may_be_noise =
      equations.pairs >= kPairsOfWalls && hold.share() < kMostOfNoise * min_share;
  const bool is_held =
      hold.share() >= min_share &&
      (!may_be_noise || HoldOf(pairing.ConfirmedInformation(T_ref_cur)).share() >= min_share);
  if (is_held) return Eigen::Matrix3d::Identity();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  direction.head<2>() = hold.weakest;
  const Eigen::Matrix3d others = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  A = (others * A * others).eval();
  equations.b = (others * equations.b).eval();
  return others;
}

// How well the pairs fit, beside what the error model expects.
double MisfitOf(const NormalEquations& equations) {
  return (equations.sum_of_misfits + kPairsOfExpectation) /
         (equations.sum_of_weights + kPairsOfExpectation);
}

// Information of the pairs in real units. Laser and surfaces are better or worse than modelled by
// as much as the pairs fit; identity weights know no units, and the residuals give them.
Eigen::Matrix3d InformationOf(const NormalEquations& equations,
                              const WeightedScanMatcherOptions& options) {
  if (options.weighting == PairWeighting::kModelled) {
    return equations.A / MisfitOf(equations);
  }
  const double mean_m = equations.sum_of_distances_m / std::max(1, equations.pairs);
  const double sigma_m = std::max(mean_m, options.noise.range_sigma_m);
  return equations.A / (sigma_m * sigma_m);
}

// The same from the errors that the readings show, pair by pair, where the modelled ones only
// weigh: A B^-1 A, B being the covariance of b (White 1980). One scale for all pairs lets the many
// that are better than modelled speak for the few far ones that tell the heading.
Eigen::Matrix3d InformationByScatter(const NormalEquations& equations,
                                     const Eigen::Matrix3d& scatter) {
  const double pairs = equations.sum_of_weights;
  const Eigen::Matrix3d B =
      (pairs * scatter + kPairsOfExpectation * equations.A) / (pairs + kPairsOfExpectation);
  const Eigen::Matrix3d information =
      equations.A * B.completeOrthogonalDecomposition().pseudoInverse() * equations.A;
  return 0.5 * (information + information.transpose());
}

Eigen::Vector3d Difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, NormalizeAngle(a.theta_rad - b.theta_rad)};
}

Pose2 Moved(const Pose2& pose, const Eigen::Vector3d& step) {
  return {pose.x_m + step.x(), pose.y_m + step.y(), NormalizeAngle(pose.theta_rad + step.z())};
}

bool IsSmall(const Eigen::Vector3d& step, const WeightedScanMatcherOptions& options) {
  return step.head<2>().norm() < options.translation_tolerance_m &&
         std::abs(step.z()) < options.rotation_tolerance_rad;
}

// Whether enough of the scan agrees with the answer, and the answer with the prediction.
bool IsConsistent(const MatchResult& result,
                  const MatchPrior& prior,
                  const WeightedScanMatcherOptions& options) {
  const Eigen::Vector3d way = Difference(result.T_ref_cur, prior.predicted.T_a_b);
  const double sigmas2 = way.dot(prior.predicted.covariance.inverse() * way);
  return result.overlap >= options.min_overlap &&
         sigmas2 <= options.max_prior_sigmas * options.max_prior_sigmas;
}

// Whether the answer is known in every direction, be it from the pairs or from the prior.
bool IsDetermined(const Eigen::Matrix3d& covariance, double max_sigma_m) {
  if (!covariance.allFinite()) return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(covariance.topLeftCorner<2, 2>(), Eigen::EigenvaluesOnly);
  return axes.eigenvalues()(1) < max_sigma_m * max_sigma_m;
}

}  // namespace

MatchResult WeightedScanMatcher::Match(const SurfaceMap& reference,
                                       std::span<const ScanPoint> points,
                                       const MatchPrior& prior,
                                       MatchTrace* trace) const {
  MatchResult result{.status = MatchStatus::kIterationLimit, .T_ref_cur = prior.start};
  const Eigen::Matrix3d prior_information = prior.predicted.covariance.inverse();
  Pairing pairing(reference, points, prior.max_drift_m2, options_);
  NormalEquations pairs;
  Eigen::Matrix3d held = Eigen::Matrix3d::Identity();
  Doubt doubt{prior.start_error};
  while (result.iterations < options_.max_iterations) {
    ++result.iterations;
    pairs = pairing.Linearize(result.T_ref_cur, doubt);
    held = DropFalseHold(pairing, result.T_ref_cur, options_.min_information_share, pairs);
    result.pairs = pairs.pairs;
    if (pairs.pairs < options_.min_pairs) {
      result.status = MatchStatus::kTooFewPairs;
      return result;
    }
    result.mean_residual_m = pairs.sum_of_distances_m / pairs.pairs;
    result.overlap = static_cast<double>(pairs.inliers) / static_cast<double>(points.size());
    result.misfit = MisfitOf(pairs);
    result.information = InformationOf(pairs, options_);

    // Fuse pairs and prediction, each by its information.
    const double independent = 1.0 / options_.correlated_points;
    const Eigen::Matrix3d information = independent * result.information + prior_information;
    const double scale = pairs.A.trace() > 0.0 ? result.information.trace() / pairs.A.trace() : 0.0;
    result.covariance = information.inverse();
    const Eigen::Vector3d step =
        result.covariance *
        (independent * scale * pairs.b +
         prior_information * Difference(prior.predicted.T_a_b, result.T_ref_cur));
    if (!IsDetermined(result.covariance, options_.max_sigma_m)) {
      result.status = MatchStatus::kDegenerate;
      return result;
    }
    result.T_ref_cur = Moved(result.T_ref_cur, step);
    if (trace != nullptr) {
      trace->push_back({.T_ref_cur = result.T_ref_cur,
                        .pairs = result.pairs,
                        .mean_residual_m = result.mean_residual_m,
                        .doubt_m = doubt.sigma.translation_m});
    }
    if (doubt.IsGone() && IsSmall(step, options_)) {
      result.status = MatchStatus::kConverged;
      break;
    }
    doubt.Shrink(options_.annealing_factor);
  }
  if (options_.weighting == PairWeighting::kModelled) {
    const Eigen::Matrix3d scatter = held * pairing.Scatter(result.T_ref_cur) * held;
    result.information = InformationByScatter(pairs, scatter);
  }
  if (!IsConsistent(result, prior, options_)) result.status = MatchStatus::kInconsistent;
  result.nearest_sample_covariance =
      (pairing.NearestSampleInformation(result.T_ref_cur) + prior_information).inverse();
  return result;
}

}  // namespace qwsm
