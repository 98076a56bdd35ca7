// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "qwsm/search/detail/paged_pool.hpp"
#include "qwsm/search/likelihood_pyramid.hpp"
#include "qwsm/search/point_quadtree.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

struct SurfaceMapOptions {
  PointQuadtreeOptions quadtree;
  LikelihoodPyramidOptions likelihood;
  double neighborhood_radius_m = kSurfaceReach_m;
  int min_neighbors = 5;
  double max_line_aspect = 0.3;
  double min_line_m = 0.03;
  double roughness_m = 0.03;
};

template <class Visitor>
void Describe(Visitor& visit, SurfaceMapOptions& o) {
  visit("quadtree", o.quadtree, {.help = "the index of all stored points"});
  visit("likelihood", o.likelihood, {.help = "the coarse levels that wide searches use"});
  visit("neighborhood_radius_m",
        o.neighborhood_radius_m,
        {.help = "stored points this near describe the surface at a point", .min = 0.01, .max = 1});
  visit("min_neighbors",
        o.min_neighbors,
        {.help = "with fewer points around, the scan's own normal is used", .min = 2, .max = 1000});
  visit(
      "max_line_aspect",
      o.max_line_aspect,
      {.help = "a neighbourhood is a line below this ratio of its variances", .min = 0, .max = 1});
  visit("min_line_m",
        o.min_line_m,
        {.help = "a neighbourhood of smaller sigma shows noise, not a direction",
         .min = 0,
         .max = 1});
  visit("roughness_m",
        o.roughness_m,
        {.help = "spread of points across a surface of which few are known", .min = 0, .max = 1});
}

/// A point to be stored.
struct MapPoint {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  /// Normal towards the laser that saw the point; zero where the scan shows no line.
  Eigen::Vector2d normal_map = Eigen::Vector2d::Zero();
  double spacing_m = 0.0;  ///< Distance to the next sample of its surface.
  double drift_m2 = 0.0;   ///< Variance of its position owing to the pose it was seen from.
};

/// The local distribution of stored points around one of them.
///
/// A new point is compared with this distribution rather than with the single nearest sample:
/// along a line the nearest sample says nothing, across it the mean is better than any one of them.
struct Surface {
  Eigen::Vector2d mean_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< Unit vector; meaningful for a line only.
  double across_m2 = 0.0;  ///< Variance along the normal; for no line, the mean of both variances.
  /// Correspondence error: variance of the nearest sample along the surface.
  double sampling_m2 = 0.0;
  double observations = 1.0;  ///< Scans that the mean is of: readings of one scan share errors.
  bool is_line = false;
  bool is_sample = false;  ///< The mean is a single sample: too few are known around it.
};

/// Variance of what is uniform over a length: the correspondence error along a surface whose
/// samples lie so far apart (Pfister et al. 2002, with the neighbours at equal distances).
inline double UniformVariance(double length_m) { return length_m * length_m / 12.0; }
/// The length from that variance.
inline double UniformLength(double variance_m2) { return std::sqrt(12.0 * variance_m2); }

/// What scans are matched against: points in a quadtree, each with the moments of its
/// neighbourhood, kept up to date as points come. A thin wall has two surfaces, one on each
/// side: points that were seen from opposite sides do not share a neighbourhood.
///
/// Const members may be called from several threads at once.
class SurfaceMap {
 public:
  explicit SurfaceMap(const SurfaceMapOptions& options = {});
  /// Surfaces that are matched with and hardly ever searched: they keep no likelihood, which takes
  /// as long to insert into as all the rest, but the means that MeanNear() tells.
  static SurfaceMap ForMatching(const SurfaceMapOptions& options);

  /// Stores a point. Complexity: logarithmic, plus linear in the points of the neighbourhood.
  /// @return false if the quadtree refused it, being not finite or too far away.
  bool Insert(const MapPoint& point, ScanId scan);

  bool empty() const { return quadtree_.empty(); }
  const PointQuadtree& quadtree() const { return quadtree_; }
  /// @pre it is kept
  const LikelihoodPyramid& likelihood() const { return *likelihood_; }
  /// The likelihood of the points as they are. Complexity: linear in the map.
  LikelihoodPyramid MakeLikelihood() const;
  /// Bytes of all memory held. Complexity: linear in the nodes of the quadtree.
  std::size_t bytes() const;
  /// Returns the surface around a stored point. Its id and position count.
  /// @pre quadtree().Contains(id), here and below.
  Surface SurfaceAt(const Neighbor& stored) const;
  /// Returns the mean of the points of that surface within half the neighbourhood's radius, in the
  /// map frame: where the surface curves, it lies a quarter as far behind it as the mean of all.
  /// Complexity: a search of the points, but of surfaces for matching.
  Eigen::Vector2d MeanNear(const Neighbor& stored) const;
  /// Has the memory fetched that SurfaceAt() and the calls below need.
  void Prefetch(PointId id) const { __builtin_prefetch(&neighborhoods_[id]); }
  /// Variance of the position of a stored point owing to the pose it was seen from, as a code of
  /// LikelihoodPyramid.
  std::uint8_t DriftCode(PointId id) const { return neighborhoods_[id].drift_code; }
  /// Returns the normal a point was stored with; zero if none.
  Eigen::Vector2d OwnNormal(PointId id) const {
    const Neighborhood& own = neighborhoods_[id];
    return Eigen::Vector2d(own.own_normal_x, own.own_normal_y) * (1.0 / kNormalScale);
  }
  /// Whether a point lies on the other side of a thin wall than what has this normal. What has no
  /// normal has no side.
  bool IsOnOtherSide(PointId id, const Eigen::Vector2d& normal_map) const {
    return OwnNormal(id).dot(normal_map) < kOpposite;
  }

 private:
  static constexpr double kNormalScale = 32767.0;
  // Normals with such a cosine between them are of opposite sides; around a corner they are not.
  static constexpr double kOpposite = -0.5;

  // Moments of the stored points within the neighbourhood radius, relative to the point itself.
  struct Neighborhood {
    float sum_x = 0.0F;
    float sum_y = 0.0F;
    float sum_xx = 0.0F;
    float sum_xy = 0.0F;
    float sum_yy = 0.0F;
    float spacing_m = 0.0F;
    std::uint16_t count = 1;        // Of kMostPoints no more are added.
    std::int16_t own_normal_x = 0;  // Of a unit vector, in 1 / kNormalScale. Both are 0 where the
    std::int16_t own_normal_y = 0;  // scan showed no line.
    std::uint8_t drift_code = 0;

    static constexpr std::uint16_t kMostPoints = 0xffff;
    void Add(const Eigen::Vector2f& offset_m);
    // Whether these lie on opposite sides of a thin wall; see IsOnOtherSide().
    bool IsOpposite(const Neighborhood& other) const {
      // Such products of 16-bit numbers are exact.
      return own_normal_x * other.own_normal_x + own_normal_y * other.own_normal_y <
             static_cast<int>(kOpposite * kNormalScale * kNormalScale);
    }
  };

  static_assert(sizeof(Neighborhood) == 32);

  // Where the points within half the radius lie, and the point itself.
  struct NearPoints {
    Eigen::Vector2f sum_m = Eigen::Vector2f::Zero();
    float count = 1.0F;
    void Add(const Eigen::Vector2f& offset_m) {
      sum_m += offset_m;
      count += 1.0F;
    }
  };

  // Calls visit(PointId, position_m) for the points of that surface within a radius, and itself.
  template <class Visit>
  void ForEachNeighbor(const Neighbor& stored, double radius_m, Visit visit) const;
  double Observations(const Neighborhood& n) const;

  SurfaceMapOptions options_;
  PointQuadtree quadtree_;
  std::optional<LikelihoodPyramid> likelihood_;
  PagedPool<Neighborhood, 8> neighborhoods_;             // By PointId.
  std::optional<PagedPool<NearPoints, 8>> near_points_;  // By PointId, of surfaces for matching.
};

}  // namespace qwsm
