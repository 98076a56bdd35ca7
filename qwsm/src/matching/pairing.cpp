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
// Annealing has ended below these, which are the same at a point ten metres away.
constexpr double kAnnealed_m = 0.002;
constexpr double kAnnealed_rad = 0.0002;
constexpr double kInlierSigmas = 3.0;
constexpr double kCosOfCrossing = 0.5;   // Lines at more than 60 degrees are not one surface.
constexpr double kCosOfStraight = 0.95;  // Within 18 degrees, map and scan show the same line.

// Weight of Geman & McClure (1987): falls from 1 to a quarter at the outlier limit, and on towards
// 0.
double RobustWeight(double mahalanobis2, double outlier_sigmas) {
  const double w = 1.0 / (1.0 + mahalanobis2 / (outlier_sigmas * outlier_sigmas));
  return w * w;
}

// Whether no other reading of the scan is of the same surface nearby, and whether one is near.
bool IsAlone(const ScanPoint& point) { return point.to_mean_robot_m.isZero(); }
bool HasNear(const ScanPoint& point) { return !point.to_mean_near_robot_m.isZero(); }

// Whether both show a line, by several points within one reach, and these cross: the end face of a
// wall beside one that is seen for the first time.
bool LinesCross(const Surface& surface, const ScanPoint& point, const Eigen::Vector2d& normal_map) {
  return surface.is_line && !surface.is_sample && point.spacing_m < kSurfaceReach_m &&
         !normal_map.isZero() && std::abs(surface.normal.dot(normal_map)) < kCosOfCrossing;
}

}  // namespace

double AnnealedError::Variance_m2(double range_m) const {
  const double turn_m = sigma.rotation_rad * range_m;
  return sigma.translation_m * sigma.translation_m + turn_m * turn_m;
}

void AnnealedError::Anneal(double factor) {
  sigma.translation_m *= factor;
  sigma.rotation_rad *= factor;
  if (sigma.translation_m < kAnnealed_m) sigma.translation_m = 0.0;
  if (sigma.rotation_rad < kAnnealed_rad) sigma.rotation_rad = 0.0;
}

void NormalEquations::AddPoint(const Eigen::Matrix2d& information,
                               const Eigen::Vector2d& error,
                               const Eigen::Vector2d& arm) {
  // H^T S^-1 H and H^T S^-1 e for H = [ I | J R u ].
  const Eigen::Vector2d by_theta(-arm.y(), arm.x());
  const Eigen::Vector2d cross = information * by_theta;
  A.topLeftCorner<2, 2>() += information;
  A.topRightCorner<2, 1>() += cross;
  A.bottomLeftCorner<1, 2>() += cross.transpose();
  A(2, 2) += by_theta.dot(cross);
  b.head<2>() += information * error;
  b(2) += cross.dot(error);
}

void NormalEquations::AddLine(double information,
                              const Eigen::Vector2d& normal,
                              double error_m,
                              const Eigen::Vector2d& arm) {
  const Eigen::Vector3d h = PullOnPose(normal, arm);
  const Eigen::Vector3d weighted = information * h;
  A.noalias() += weighted * h.transpose();
  b += weighted * error_m;
}

Pairing::Pairing(const SurfaceMap& map,
                 std::span<const ScanPoint> points,
                 double max_drift_m2,
                 const WeightedScanMatcherOptions& options)
    : map_(map),
      points_(points),
      max_drift_code_(LikelihoodPyramid::DriftCode(max_drift_m2)),
      options_(options),
      pairs_(points.size()) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    points_apart_ += pairs_[i].news = NewsOf(points, i);
  }
}

NormalEquations Pairing::Linearize(const Pose2& T_map_cur, const AnnealedError& start_error) {
  FindNearest(T_map_cur, start_error);
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  for (std::size_t i = 0; i < points_.size(); ++i) FindSurface(R, points_[i], pairs_[i]);
  if (options_.selection == PairSelection::kOneToOne) SelectOneToOne(R);

  NormalEquations equations;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ScanPoint& point = points_[i];
    Pair& pair = pairs_[i];
    if (!pair.id) continue;
    ++equations.pairs;
    equations.sum_of_distances_m += std::sqrt(pair.nearest->distance_m2);
    if (options_.weighting == PairWeighting::kIdentity) {
      equations.AddPoint(pair.share * Eigen::Matrix2d::Identity(),
                         pair.nearest->position_m - pair.p_map,
                         pair.arm);
      equations.inliers += pair.news;
    } else if (pair.surface.is_line) {
      AddLine(R, point, pair, equations);
    } else {
      AddObject(R, point, pair, equations);
    }
  }
  return equations;
}

// Where all points lie in the map, and what lies nearest to them there. One loop for all, and what
// it finds is fetched meanwhile: the searches wait for memory more than they compute.
void Pairing::FindNearest(const Pose2& T_map_cur, const AnnealedError& start_error) {
  const PointQuadtree& quadtree = map_.quadtree();
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  const SearchCursor none;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Pair& pair = pairs_[i];
    pair.arm = R * points_[i].p_robot_m;
    pair.p_map = pair.arm + T_map_cur.translation_m();
    pair.inflation_m2 = start_error.Variance_m2(points_[i].range_m);
    if (pair.cursor.revision == 0) {
      // The neighbouring beam ended near here.
      const SearchCursor& beside = i > 0 ? pairs_[i - 1].cursor : none;
      pair.cursor = quadtree.CursorAt(pair.p_map, beside);
    }
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Pair& pair = pairs_[i];
    pair.nearest = quadtree.Nearest(pair.p_map, Reach(pair.inflation_m2), pair.cursor);
    if (pair.nearest) map_.Prefetch(pair.nearest->id);
  }
}

// The surface to pair a point with, if there is one.
void Pairing::FindSurface(const Eigen::Matrix2d& R_map_cur,
                          const ScanPoint& point,
                          Pair& pair) const {
  if (pair.nearest && pair.nearest->id == pair.id) return;
  const Eigen::Vector2d normal_map = R_map_cur * point.normal_robot;
  if (pair.nearest && !MayPair(pair.nearest->id, normal_map)) {
    pair.nearest = map_.quadtree().NearestIf(
        pair.p_map, Reach(pair.inflation_m2), [&](PointId id) { return MayPair(id, normal_map); });
  }
  if (!pair.nearest) return pair.id.reset();
  if (pair.id != pair.nearest->id) {
    pair.surface = map_.SurfaceAt(*pair.nearest);
    pair.mean_near_m.reset();
  }
  pair.id = pair.nearest->id;
  if (LinesCross(pair.surface, point, normal_map)) pair.id.reset();
}

// Points that are left out still tell that they agree, those beyond an end do not even that.
void Pairing::SelectOneToOne(const Eigen::Matrix2d& R_map_cur) {
  Pair* selected = nullptr;  // Of the points with the same stored one, up to here.
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Pair& pair = pairs_[i];
    if (pair.id && IsBeyondEnd(R_map_cur, points_[i], pair)) pair.id.reset();
    pair.share = 1.0;
    if (!pair.id || !selected || selected->id != pair.id) {
      selected = pair.id ? &pair : nullptr;
    } else if (pair.nearest->distance_m2 < selected->nearest->distance_m2) {
      selected->share = 0.0;
      selected = &pair;
    } else {
      pair.share = 0.0;
    }
  }
}

// Whether a point lies further along the surface than its samples are apart: beyond its end, or in
// a gap.
bool Pairing::IsBeyondEnd(const Eigen::Matrix2d& R_map_cur,
                          const ScanPoint& point,
                          const Pair& pair) {
  const Surface& surface = pair.surface;
  const Eigen::Vector2d normal = surface.is_line ? surface.normal : R_map_cur * point.normal_robot;
  if (normal.isZero()) return false;
  const Eigen::Vector2d tangent(-normal.y(), normal.x());
  const double along_m = std::abs(tangent.dot(pair.nearest->position_m - pair.p_map));
  const double spacing_m = std::max(point.spacing_m, UniformLength(surface.sampling_m2));
  return along_m > spacing_m + std::sqrt(pair.inflation_m2);
}

void Pairing::AddLine(const Eigen::Matrix2d& R_map_cur,
                      const ScanPoint& point,
                      Pair& pair,
                      NormalEquations& equations) const {
  const Surface& surface = pair.surface;
  const Eigen::Vector2d& normal = surface.normal;
  const double noise_m2 =
      NoiseAlong(normal, R_map_cur * point.beam_robot, point.range_m, options_.noise);
  const double variance_m2 = DistanceVariance(surface, noise_m2, pair.inflation_m2);
  // Visser et al. (2009), Eq. (1): epsilon, of which a line tells the part along its normal.
  const double error_m = normal.dot(surface.mean_m - pair.p_map);
  Weigh(error_m * error_m / variance_m2, pair, equations);
  equations.AddLine(
      pair.weight / variance_m2, normal, normal.dot(ErrorOfLike(R_map_cur, point, pair)), pair.arm);
}

// How far a point is from a surface, by what is alike: means are compared with means, as wide.
Eigen::Vector2d Pairing::ErrorOfLike(const Eigen::Matrix2d& R_map_cur,
                                     const ScanPoint& point,
                                     Pair& pair) const {
  const Surface& surface = pair.surface;
  if (surface.is_sample) return surface.mean_m - pair.p_map;
  if (ComparesNear(R_map_cur, point, surface)) {
    if (!pair.mean_near_m) pair.mean_near_m = map_.MeanNear(*pair.nearest);
    return *pair.mean_near_m - (pair.p_map + R_map_cur * point.to_mean_near_robot_m);
  }
  if (!surface.is_line) return surface.mean_m - pair.p_map;
  return surface.mean_m - (pair.p_map + R_map_cur * point.to_mean_robot_m);
}

// Where a surface curves, bends or ends, as a trunk, a corner and a door frame do, the mean of its
// points lies aside of them, and further in the map than in what a scan sees of it: by means within
// half the reach less so. A reading that is alone is its own mean; of readings of a line that are
// further apart than half the reach only the mean of all is of several.
bool Pairing::ComparesNear(const Eigen::Matrix2d& R_map_cur,
                           const ScanPoint& point,
                           const Surface& surface) const {
  const bool is_near = options_.comparison == PairComparison::kNear;
  if (!surface.is_line) return is_near;
  if (!IsAlone(point) && !(is_near && HasNear(point))) return false;
  return std::abs(surface.normal.dot(R_map_cur * point.normal_robot)) <= kCosOfStraight;
}

void Pairing::AddObject(const Eigen::Matrix2d& R_map_cur,
                        const ScanPoint& point,
                        Pair& pair,
                        NormalEquations& equations) const {
  const Eigen::Matrix2d information = PositionInformation(
      pair.surface, NoiseInMap(R_map_cur, point), Extent_m2(point) + pair.inflation_m2);
  // Visser et al. (2009), Eq. (1): epsilon = m - (R u + t).
  const Eigen::Vector2d error = ErrorOfLike(R_map_cur, point, pair);
  Weigh(error.dot(information * error), pair, equations);
  equations.AddPoint(pair.weight * information, error, pair.arm);
}

void Pairing::Weigh(double mahalanobis2, Pair& pair, NormalEquations& equations) const {
  pair.weight = pair.share * RobustWeight(mahalanobis2, options_.outlier_sigmas);
  if (mahalanobis2 < kInlierSigmas * kInlierSigmas) equations.inliers += pair.news;
  equations.sum_of_weights += pair.weight;
  equations.weighted_chi2 += pair.weight * mahalanobis2;
}

Eigen::Matrix3d Pairing::NearestSampleInformation(const Pose2& T_map_cur) const {
  NormalEquations equations;
  const Eigen::Matrix2d R = T_map_cur.Rotation();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Pair& pair = pairs_[i];
    if (!pair.id) continue;
    const Eigen::Matrix2d S = NearestSampleError(pair.surface, NoiseInMap(R, points_[i]));
    equations.AddPoint(
        pair.weight * S.inverse(), Eigen::Vector2d::Zero(), R * points_[i].p_robot_m);
  }
  return equations.A;
}

double Pairing::Reach(double inflation_m2) const {
  return std::max(options_.pair_distance_m, kPairDistancePerError * std::sqrt(inflation_m2));
}

Eigen::Matrix2d Pairing::NoiseInMap(const Eigen::Matrix2d& R_map_cur,
                                    const ScanPoint& point) const {
  return PointCovariance(R_map_cur * point.beam_robot, point.range_m, options_.noise);
}

// Of what is no line: a beam hits it anywhere.
double Pairing::Extent_m2(const ScanPoint& point) const {
  return options_.small_object_m * options_.small_object_m + UniformVariance(point.spacing_m);
}

bool Pairing::MayPair(PointId id, const Eigen::Vector2d& normal_map) const {
  return map_.DriftCode(id) <= max_drift_code_ && !map_.IsOnOtherSide(id, normal_map);
}

}  // namespace qwsm
