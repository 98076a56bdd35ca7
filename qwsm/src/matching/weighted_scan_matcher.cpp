// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/weighted_scan_matcher.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "qwsm/matching/pair_error.hpp"

namespace qwsm {
namespace {

constexpr double kPairDistancePerError = 5.0;  // Pairs are sought as far as the error may reach.
constexpr double kSmallestDoubt_m = 0.002;     // Below, annealing has ended;
constexpr double kSmallestDoubt_rad = 0.0002;  // the same ten metres away.
constexpr double kInlierSigmas = 3.0;
constexpr double kPairsOfExpectation = 50.0;  // What the error model is worth beside the pairs.

// A scan point with its counterpart in the map, kept from iteration to iteration.
struct Pair {
  SearchCursor cursor;
  std::optional<PointId> id;
  double distance_m2 = 0.0;
  double weight = 1.0;  // Of the robust estimate.
  Eigen::Vector2d nearest_m = Eigen::Vector2d::Zero();
  Surface surface;
};

// Doubt about the current estimate, taken back from iteration to iteration: with it all pairs look
// plausible at first, and a poor first guess does not make the true pairs outliers.
struct Doubt {
  StartError sigma;

  bool IsGone() const { return sigma.translation_m == 0.0 && sigma.rotation_rad == 0.0; }
  /// Variance of a point's position.
  double At_m2(double range_m) const {
    const double turn_m = sigma.rotation_rad * range_m;
    return sigma.translation_m * sigma.translation_m + turn_m * turn_m;
  }
  void Shrink(double factor) {
    sigma.translation_m *= factor;
    sigma.rotation_rad *= factor;
    if (sigma.translation_m < kSmallestDoubt_m) sigma.translation_m = 0.0;
    if (sigma.rotation_rad < kSmallestDoubt_rad) sigma.rotation_rad = 0.0;
  }
};

// Derivative of R u + t by (x, y, theta), [ I | J R u ], for arm = R u.
Eigen::Matrix<double, 2, 3> DerivativeByPose(const Eigen::Vector2d& arm) {
  Eigen::Matrix<double, 2, 3> H;
  H << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return H;
}

// Normal equations of the weighted least squares: A step = b.
struct NormalEquations {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  int pairs = 0;
  int inliers = 0;
  double sum_of_distances_m = 0.0;
  double sum_of_weights = 0.0;
  double sum_of_misfits = 0.0;  // Squared, weighted, in units of the modelled errors.

  void Add(const Eigen::Matrix2d& weight,
           const Eigen::Vector2d& error,
           const Eigen::Vector2d& arm) {
    const Eigen::Matrix<double, 2, 3> H = DerivativeByPose(arm);
    const Eigen::Matrix<double, 3, 2> HtW = H.transpose() * weight;
    A.noalias() += HtW * H;
    b.noalias() += HtW * error;
  }
};

// Geman-McClure: falls from 1 to a quarter at the outlier limit, and on towards 0.
double RobustWeight(double mahalanobis2, double outlier_sigmas) {
  const double w = 1.0 / (1.0 + mahalanobis2 / (outlier_sigmas * outlier_sigmas));
  return w * w;
}

// Pairs of one scan with a map.
class Pairing {
 public:
  Pairing(const SurfaceMap& map,
          std::span<const ScanPoint> points,
          double max_drift_m2,
          const WeightedScanMatcherOptions& options)
      : map_(map),
        points_(points),
        max_drift_m2_(max_drift_m2),
        options_(options),
        pairs_(points.size()) {}

  NormalEquations Linearize(const Pose2& T_map_cur, const Doubt& doubt) {
    NormalEquations equations;
    const Eigen::Matrix2d R = T_map_cur.Rotation();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const ScanPoint& point = points_[i];
      const Eigen::Vector2d arm = R * point.p_robot_m;
      const Eigen::Vector2d p_map = arm + T_map_cur.translation_m();
      const double doubt_m2 = doubt.At_m2(point.range_m);
      Pair& pair = pairs_[i];
      if (!FindPair(p_map, Reach(doubt_m2), pair)) continue;
      ++equations.pairs;
      equations.sum_of_distances_m += std::sqrt(pair.distance_m2);
      if (options_.weighting == PairWeighting::kIdentity) {
        equations.Add(Eigen::Matrix2d::Identity(), pair.nearest_m - p_map, arm);
        ++equations.inliers;
        continue;
      }
      const Eigen::Vector2d error = pair.surface.mean_m - p_map;
      const Eigen::Matrix2d information =
          PairInformation(pair.surface, NoiseInMap(R, point), Extent_m2(point), doubt_m2);
      const double mahalanobis2 = error.dot(information * error);
      if (mahalanobis2 < kInlierSigmas * kInlierSigmas) ++equations.inliers;
      pair.weight = RobustWeight(mahalanobis2, options_.outlier_sigmas);
      equations.sum_of_weights += pair.weight;
      equations.sum_of_misfits += pair.weight * mahalanobis2;
      equations.Add(pair.weight * information, error, arm);
    }
    return equations;
  }

  // A^-1 of the pairs found last, were each the nearest sample of the papers.
  Eigen::Matrix3d NearestSampleCovariance(const Pose2& T_map_cur) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    const Eigen::Matrix2d R = T_map_cur.Rotation();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Pair& pair = pairs_[i];
      if (!pair.id) continue;
      const auto H = DerivativeByPose(R * points_[i].p_robot_m);
      const Eigen::Matrix2d S = NearestSampleError(pair.surface, NoiseInMap(R, points_[i]));
      A += pair.weight * H.transpose() * S.inverse() * H;
    }
    return A.inverse();
  }

 private:
  double Reach(double doubt_m2) const {
    return std::max(options_.pair_distance_m, kPairDistancePerError * std::sqrt(doubt_m2));
  }

  Eigen::Matrix2d NoiseInMap(const Eigen::Matrix2d& R_map_cur, const ScanPoint& point) const {
    return PointCovariance(R_map_cur * point.beam_robot, point.range_m, options_.noise);
  }

  // Of what is no line: a beam hits it anywhere.
  double Extent_m2(const ScanPoint& point) const {
    return options_.small_object_m * options_.small_object_m + UniformVariance(point.spacing_m);
  }

  bool FindPair(const Eigen::Vector2d& p_map, double reach_m, Pair& pair) const {
    const auto nearest = map_.quadtree().Nearest(p_map, reach_m, pair.cursor);
    if (!nearest || map_.Drift_m2(nearest->id) > max_drift_m2_) {
      pair.id.reset();
      return false;
    }
    if (pair.id != nearest->id) pair.surface = map_.SurfaceAt(nearest->id);
    pair.id = nearest->id;
    pair.distance_m2 = nearest->distance_m2;
    pair.nearest_m = nearest->position_m;
    return true;
  }

  const SurfaceMap& map_;
  std::span<const ScanPoint> points_;
  double max_drift_m2_;
  const WeightedScanMatcherOptions& options_;
  std::vector<Pair> pairs_;
};

// Takes back what pairs seem to say about a direction of which they say next to nothing: normals of
// noisy walls are never quite parallel, and their errors would pass for a hold along a corridor
// (Zhang, Kaess & Singh 2016).
void DropFalseHold(double min_share, NormalEquations& equations) {
  Eigen::Matrix3d& A = equations.A;
  const Eigen::Vector2d cross = A.topRightCorner<2, 1>();
  const Eigen::Matrix2d of_position =
      A.topLeftCorner<2, 2>() - cross * cross.transpose() / std::max(A(2, 2), 1e-12);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(of_position);
  if (axes.eigenvalues()(0) >= min_share * axes.eigenvalues()(1)) return;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  direction.head<2>() = axes.eigenvectors().col(0);
  const Eigen::Matrix3d others = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  A = (others * A * others).eval();
  equations.b = (others * equations.b).eval();
}

// Information of the pairs in real units. Laser and surfaces are better or worse than modelled by
// as much as the pairs fit; identity weights know no units, and the residuals give them.
Eigen::Matrix3d InformationOf(const NormalEquations& equations,
                              const WeightedScanMatcherOptions& options) {
  if (options.weighting == PairWeighting::kModelled) {
    const double misfit = (equations.sum_of_misfits + kPairsOfExpectation) /
                          (equations.sum_of_weights + kPairsOfExpectation);
    return equations.A / misfit;
  }
  const double mean_m = equations.sum_of_distances_m / std::max(1, equations.pairs);
  const double sigma_m = std::max(mean_m, options.noise.range_sigma_m);
  return equations.A / (sigma_m * sigma_m);
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
  Doubt doubt{prior.start_error};
  while (result.iterations < options_.max_iterations) {
    ++result.iterations;
    NormalEquations pairs = pairing.Linearize(result.T_ref_cur, doubt);
    DropFalseHold(options_.min_information_share, pairs);
    result.pairs = pairs.pairs;
    if (pairs.pairs < options_.min_pairs) {
      result.status = MatchStatus::kTooFewPairs;
      return result;
    }
    result.mean_residual_m = pairs.sum_of_distances_m / pairs.pairs;
    result.overlap = static_cast<double>(pairs.inliers) / static_cast<double>(points.size());
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
  result.nearest_sample_covariance = pairing.NearestSampleCovariance(result.T_ref_cur);
  return result;
}

}  // namespace qwsm
