// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "pairing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "qwsm/matching/pair_error.hpp"

namespace qwsm {
namespace {

constexpr double kPairDistancePerError = 5.0;  // Pairs are sought as far as the error may reach.
constexpr double kSmallestDoubt_m = 0.002;     // Below, annealing has ended;
constexpr double kSmallestDoubt_rad = 0.0002;  // the same ten metres away.
constexpr double kInlierSigmas = 3.0;
constexpr double kFirstCircle_m = 0.1;  // Beyond a point that cannot be paired: the next surface.

// Derivative of R u + t by (x, y, theta), [ I | J R u ], for arm = R u.
Eigen::Matrix<double, 2, 3> DerivativeByPose(const Eigen::Vector2d& arm) {
  Eigen::Matrix<double, 2, 3> H;
  H << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  return H;
}

// Geman-McClure: falls from 1 to a quarter at the outlier limit, and on towards 0.
double RobustWeight(double mahalanobis2, double outlier_sigmas) {
  const double w = 1.0 / (1.0 + mahalanobis2 / (outlier_sigmas * outlier_sigmas));
  return w * w;
}

}  // namespace

double Doubt::At_m2(double range_m) const {
  const double turn_m = sigma.rotation_rad * range_m;
  return sigma.translation_m * sigma.translation_m + turn_m * turn_m;
}

void Doubt::Shrink(double factor) {
  sigma.translation_m *= factor;
  sigma.rotation_rad *= factor;
  if (sigma.translation_m < kSmallestDoubt_m) sigma.translation_m = 0.0;
  if (sigma.rotation_rad < kSmallestDoubt_rad) sigma.rotation_rad = 0.0;
}

void NormalEquations::Add(const Eigen::Matrix2d& weight,
                          const Eigen::Vector2d& error,
                          const Eigen::Vector2d& arm) {
  const Eigen::Matrix<double, 2, 3> H = DerivativeByPose(arm);
  const Eigen::Matrix<double, 3, 2> HtW = H.transpose() * weight;
  A.noalias() += HtW * H;
  b.noalias() += HtW * error;
}

Pairing::Pairing(const SurfaceMap& map,
                 std::span<const ScanPoint> points,
                 double max_drift_m2,
                 const WeightedScanMatcherOptions& options)
    : map_(map),
      points_(points),
      max_drift_m2_(max_drift_m2),
      options_(options),
      pairs_(points.size()) {}

NormalEquations Pairing::Linearize(const Pose2& T_map_cur, const Doubt& doubt) {
  NormalEquations equations;
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ScanPoint& point = points_[i];
    const Eigen::Vector2d arm = R * point.p_robot_m;
    const Eigen::Vector2d p_map = arm + T_map_cur.translation_m();
    const double doubt_m2 = doubt.At_m2(point.range_m);
    Pair& pair = pairs_[i];
    // The neighbouring beam ended near here.
    if (i > 0 && pair.cursor.revision == 0) pair.cursor = pairs_[i - 1].cursor;
    const Query query{
        .p_map = p_map, .normal_map = R * point.normal_robot, .reach_m = Reach(doubt_m2)};
    if (!FindPair(query, pair)) continue;
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
    // Where a surface curves, a mean lies behind the points: means are compared with means.
    const bool is_mean = pair.surface.is_line && !pair.surface.is_sample;
    const Eigen::Vector2d of_means = error - (is_mean ? 1.0 : 0.0) * (R * point.to_mean_robot_m);
    equations.Add(pair.weight * information, of_means, arm);
  }
  return equations;
}

Eigen::Matrix3d Pairing::NearestSampleInformation(const Pose2& T_map_cur) const {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (!pair.id) continue;
    const auto H = DerivativeByPose(R * points_[i].p_robot_m);
    const Eigen::Matrix2d S = NearestSampleError(pair.surface, NoiseInMap(R, points_[i]));
    A += pair.weight * H.transpose() * S.inverse() * H;
  }
  return A;
}

double Pairing::Reach(double doubt_m2) const {
  return std::max(options_.pair_distance_m, kPairDistancePerError * std::sqrt(doubt_m2));
}

Eigen::Matrix2d Pairing::NoiseInMap(const Eigen::Matrix2d& R_map_cur,
                                    const ScanPoint& point) const {
  return PointCovariance(R_map_cur * point.beam_robot, point.range_m, options_.noise);
}

// Of what is no line: a beam hits it anywhere.
double Pairing::Extent_m2(const ScanPoint& point) const {
  return options_.small_object_m * options_.small_object_m + UniformVariance(point.spacing_m);
}

bool Pairing::FindPair(const Query& query, Pair& pair) const {
  const std::optional<Neighbor> nearest = NearestThatMayPair(query, pair.cursor);
  if (!nearest) {
    pair.id.reset();
    return false;
  }
  if (pair.id != nearest->id) pair.surface = map_.SurfaceAt(nearest->id);
  pair.id = nearest->id;
  pair.distance_m2 = nearest->distance_m2;
  pair.nearest_m = nearest->position_m;
  return true;
}

bool Pairing::MayPair(const Query& query, PointId id) const {
  return map_.Drift_m2(id) <= max_drift_m2_ && !map_.IsOnOtherSide(id, query.normal_map);
}

std::optional<Neighbor> Pairing::NearestThatMayPair(const Query& query,
                                                    SearchCursor& cursor) const {
  const auto nearest = map_.quadtree().Nearest(query.p_map, query.reach_m, cursor);
  if (!nearest || MayPair(query, nearest->id)) return nearest;
  // Seldom: look around in widening circles.
  double radius_m = std::min(query.reach_m, std::sqrt(nearest->distance_m2) + kFirstCircle_m);
  while (true) {
    const std::optional<Neighbor> found = NearestThatMayPairWithin(radius_m, query);
    if (found || radius_m >= query.reach_m) return found;
    radius_m = std::min(2.0 * radius_m, query.reach_m);
  }
}

std::optional<Neighbor> Pairing::NearestThatMayPairWithin(double radius_m,
                                                          const Query& query) const {
  std::optional<Neighbor> nearest;
  map_.quadtree().ForEachInRadius(
      query.p_map, radius_m, [&](PointId id, const Eigen::Vector2d& position_m) {
        const double distance_m2 = (position_m - query.p_map).squaredNorm();
        if (nearest && nearest->distance_m2 <= distance_m2) return;
        if (MayPair(query, id)) {
          nearest = {.id = id, .distance_m2 = distance_m2, .position_m = position_m};
        }
      });
  return nearest;
}

}  // namespace qwsm
