// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/surface_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "qwsm/geometry/moments.hpp"

namespace qwsm {
namespace {

// Variance across a surface, from that of a few samples and what is expected before any. Fitting
// the line has used up two degrees of freedom, so that the sum of squares is over count - 2; the
// expectation counts as two samples and makes up for them.
double Spread(double sample_m2, double count, double expected_m) {
  constexpr double kSamplesOfLine = 2.0;
  return (count * sample_m2 + kSamplesOfLine * expected_m * expected_m) / count;
}

// Correspondence error along a line of which `count` samples have that variance. Uniform over a
// length L, they have L^2 / 12; what is uniform over the spacing L / count has this.
double SamplingOfLine(double major_m2, double count) {
  const double share = 1.0 / count;
  return major_m2 * share * share;
}

// The same in any direction of samples spread over an area: uniform over a square of side L they
// have L^2 / 12 along both axes, and what is uniform over the share of one, a square of side
// L / sqrt(count), has that over count. The sum for both axes bounds that along any one.
double SamplingOfArea(double minor_m2, double major_m2, double count) {
  return (minor_m2 + major_m2) * (1.0 / count);
}

// A new id is the next one, or that of a point that is gone.
template <class T, class Pool>
void Put(const T& element, PointId id, Pool& pool) {
  if (pool.end() == id) {
    pool.Add(element);
  } else {
    pool[id] = element;
  }
}

}  // namespace

SurfaceMap::SurfaceMap(const SurfaceMapOptions& options)
    : options_(options), quadtree_(options.quadtree), likelihood_(options.likelihood) {}

SurfaceMap SurfaceMap::ForMatching(const SurfaceMapOptions& options) {
  SurfaceMap surfaces(options);
  surfaces.likelihood_.reset();
  surfaces.near_points_.emplace();
  return surfaces;
}

// Four of the sums are added to side by side.
inline void SurfaceMap::Neighborhood::Add(const Eigen::Vector2f& offset_m) {
  if (count == kMostPoints) return;
  using FourSums = float __attribute__((vector_size(16)));
  static_assert(offsetof(Neighborhood, sum_x) == 0 && offsetof(Neighborhood, sum_y) == 4 &&
                offsetof(Neighborhood, sum_xx) == 8 && offsetof(Neighborhood, sum_xy) == 12);
  const float x = offset_m.x();
  const float y = offset_m.y();
  FourSums sums;
  std::memcpy(&sums, static_cast<const void*>(this), sizeof sums);
  sums += FourSums{x, y, x * x, x * y};
  std::memcpy(static_cast<void*>(this), &sums, sizeof sums);
  sum_yy += y * y;
  ++count;
}

template <class Visit>
void SurfaceMap::ForEachNeighbor(const Neighbor& stored, double radius_m, Visit visit) const {
  const Neighborhood own = neighborhoods_[stored.id];
  quadtree_.ForEachInRadius(
      stored.position_m, radius_m, [&](PointId other, const Eigen::Vector2d& other_m) {
        if (!own.IsOpposite(neighborhoods_[other])) visit(other, other_m);
      });
}

bool SurfaceMap::Insert(const MapPoint& point, ScanId scan) {
  const auto insertion = quadtree_.Insert(point.p_map_m, scan);
  if (!insertion) return false;
  if (insertion->merged) return true;
  Neighborhood own{
      .spacing_m = static_cast<float>(point.spacing_m),
      .own_normal_x = static_cast<std::int16_t>(std::lround(kNormalScale * point.normal_map.x())),
      .own_normal_y = static_cast<std::int16_t>(std::lround(kNormalScale * point.normal_map.y())),
      .drift_code = LikelihoodPyramid::DriftCode(point.drift_m2)};
  Put(own, insertion->id, neighborhoods_);
  NearPoints own_near;
  const double near_m = 0.5 * options_.neighborhood_radius_m;
  const auto near_m2 = static_cast<float>(near_m * near_m);
  ForEachNeighbor({.id = insertion->id, .position_m = insertion->position_m},
                  options_.neighborhood_radius_m,
                  [&](PointId other, const Eigen::Vector2d& other_m) {
                    if (other == insertion->id) return;
                    const Eigen::Vector2f offset_m =
                        (other_m - insertion->position_m).cast<float>();
                    own.Add(offset_m);
                    neighborhoods_[other].Add(-offset_m);
                    if (!near_points_ || offset_m.squaredNorm() > near_m2) return;
                    own_near.Add(offset_m);
                    (*near_points_)[other].Add(-offset_m);
                  });
  neighborhoods_[insertion->id] = own;
  if (near_points_) Put(own_near, insertion->id, *near_points_);
  if (likelihood_) likelihood_->Insert(point.p_map_m, point.drift_m2);
  return true;
}

LikelihoodPyramid SurfaceMap::MakeLikelihood() const {
  LikelihoodPyramid likelihood(options_.likelihood);
  quadtree_.ForEach([&](PointId id, const Eigen::Vector2d& p_m) {
    likelihood.Insert(p_m, LikelihoodPyramid::DriftOf(DriftCode(id)));
  });
  return likelihood;
}

std::size_t SurfaceMap::bytes() const {
  return quadtree_.Statistics().bytes + (likelihood_ ? likelihood_->bytes() : 0) +
         neighborhoods_.bytes() + (near_points_ ? near_points_->bytes() : 0);
}

// A scan puts about so many points into a neighbourhood as its beams are spaced.
double SurfaceMap::Observations(const Neighborhood& n) const {
  const double samples_of_a_scan =
      1.0 + 2.0 * options_.neighborhood_radius_m / static_cast<double>(n.spacing_m);
  return std::max(1.0, static_cast<double>(n.count) / samples_of_a_scan);
}

Surface SurfaceMap::SurfaceAt(const Neighbor& stored) const {
  const Neighborhood& n = neighborhoods_[stored.id];
  const Eigen::Vector2d& p_m = stored.position_m;
  const double count = static_cast<double>(n.count);
  const double scale = 1.0 / count;
  const Eigen::Vector2d mean = scale * Eigen::Vector2f(n.sum_x, n.sum_y).cast<double>();
  const PrincipalAxes axes =
      PrincipalAxesOf(static_cast<double>(n.sum_xx) * scale - mean.x() * mean.x(),
                      static_cast<double>(n.sum_xy) * scale - mean.x() * mean.y(),
                      static_cast<double>(n.sum_yy) * scale - mean.y() * mean.y());
  const bool is_dense = n.count >= options_.min_neighbors;
  const bool is_line = is_dense && axes.minor_m2 < options_.max_line_aspect * axes.major_m2;
  if (is_line && axes.major_m2 > options_.min_line_m * options_.min_line_m) {
    return {.mean_m = p_m + mean,
            .normal = axes.minor_axis,
            .across_m2 = Spread(axes.minor_m2, count, options_.roughness_m),
            .sampling_m2 = SamplingOfLine(axes.major_m2, count),
            .observations = Observations(n),
            .is_line = true};
  }
  const Eigen::Vector2d own_normal = OwnNormal(stored.id);
  if (!own_normal.isZero() && (is_line || !is_dense)) {
    // Too few or too close together to show a direction better than the scan itself did.
    return {.mean_m = p_m,
            .normal = own_normal,
            .across_m2 = 0.0,
            .sampling_m2 = UniformVariance(static_cast<double>(n.spacing_m)),
            .is_line = true,
            .is_sample = true};
  }
  return {.mean_m = p_m + mean,
          .normal = axes.minor_axis,
          .across_m2 = 0.5 * (axes.minor_m2 + axes.major_m2),
          .sampling_m2 = is_dense ? SamplingOfArea(axes.minor_m2, axes.major_m2, count)
                                  : UniformVariance(static_cast<double>(n.spacing_m)),
          .observations = Observations(n),
          .is_line = false};
}

Eigen::Vector2d SurfaceMap::MeanNear(const Neighbor& stored) const {
  if (near_points_) {
    const NearPoints& near = (*near_points_)[stored.id];
    return stored.position_m + (near.sum_m / near.count).cast<double>();
  }
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double count = 0.0;
  ForEachNeighbor(
      stored, 0.5 * options_.neighborhood_radius_m, [&](PointId, const Eigen::Vector2d& other_m) {
        sum += other_m;
        count += 1.0;
      });
  return sum / count;
}

}  // namespace qwsm
