// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/geometry/frame_covariance.hpp"
#include "qwsm/mapping/relevant_scan.hpp"
#include "qwsm/matching/surface_map.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Says which points of a relevant scan are stored.
enum class InsertionRule {
  kEveryPoint,  ///< All points are stored, as in Visser et al. (2009).
  kNewSurface,  ///< Points are stored where older scans have not yet put enough.
};

inline std::span<const std::pair<std::string_view, InsertionRule>> Names(InsertionRule) {
  static constexpr std::array<std::pair<std::string_view, InsertionRule>, 2> kNames = {{
      {"every-point", InsertionRule::kEveryPoint},
      {"new-surface", InsertionRule::kNewSurface},
  }};
  return kNames;
}

struct ScanMapOptions {
  SurfaceMapOptions surfaces;
  InsertionRule insertion = InsertionRule::kNewSurface;
  double density_radius_m = 0.03;
  int max_density_points = 5;
};

template <class Visitor>
void Describe(Visitor& visit, ScanMapOptions& o) {
  visit("surfaces", o.surfaces, {.help = "the stored points and what they say about surfaces"});
  visit("insertion", o.insertion, {.help = "which points of a relevant scan are stored"});
  visit("density_radius_m",
        o.density_radius_m,
        {.help = "new-surface: radius in which older points are counted before a point is stored",
         .formerly = "crowd_radius_m",
         .min = 0,
         .max = 0.5});
  visit("max_density_points",
        o.max_density_points,
        {.help = "new-surface: where so many older points lie in it, the point is not stored",
         .formerly = "crowd_points",
         .min = 1,
         .max = 1000});
}

/// The points of a scan that are to be stored among surfaces, by the insertion rule.
/// @param points as ToPoints() gives them.
std::vector<MapPoint> PointsToStore(const SurfaceMap& surfaces,
                                    std::span<const ScanPoint> points,
                                    const UncertainPose2& map_robot,
                                    const ScanMapOptions& options);

/// What a relevant scan adds to a map.
struct MapAddition {
  LaserScan scan;
  UncertainPose2 map_robot;
  std::vector<MapPoint> points;  ///< Points of the scan that are stored.
  FrameCovariance own_error;     ///< Error that it did not take over from the scans it lies on.
};

/// The union of all relevant scans: their points, searchable, and the scans themselves.
class ScanMap {
 public:
  explicit ScanMap(const ScanMapOptions& options = {});

  bool empty() const { return scans_.empty(); }
  const SurfaceMap& surfaces() const { return surfaces_; }
  std::span<const RelevantScan> scans() const { return scans_; }
  const ScanMapOptions& options() const { return options_; }

  /// Adds a relevant scan. @param points the scan's points, as ToPoints() gives them.
  ScanId Insert(LaserScan scan, std::span<const ScanPoint> points, const UncertainPose2& map_robot);
  /// Likewise, where the points of the scan are not at hand.
  ScanId Insert(LaserScan scan, const UncertainPose2& map_robot);
  /// Prepares what Insert() would add to the map as it is now.
  MapAddition Prepare(LaserScan scan,
                      std::span<const ScanPoint> points,
                      const UncertainPose2& map_robot) const;
  /// Adds what was prepared.
  ScanId Add(MapAddition addition);
  /// Forgets all points, but not the scans: what follows is matched to what is inserted next.
  void ForgetPoints();

  /// How uncertain that part of the map is which a scan lies on: the mean error of the scans that
  /// stored the points nearest to its own. Those of the last scan if none is near.
  /// @param max_drift_m2 points that drifted more do not count.
  FrameCovariance CovarianceUnder(
      std::span<const ScanPoint> points,
      const Pose2& T_map_robot,
      double max_drift_m2 = std::numeric_limits<double>::infinity()) const;

 private:
  // Of a scan's frame, in two parts that are independent of each other.
  struct ScanError {
    FrameCovariance shared;  // What it shares with the scans it lies on.
    FrameCovariance own;     // What is independent of all scans before.
  };

  ScanMapOptions options_;
  SurfaceMap surfaces_;
  std::vector<RelevantScan> scans_;  // By ScanId.
  std::vector<ScanError> errors_;    // By ScanId.
};

/// The map of scans where they are, inserted in their order.
ScanMap MapOf(std::vector<RelevantScan> scans, const ScanMapOptions& options);

/// The positions of all scans of a map.
std::vector<Eigen::Vector2d> PathOf(const ScanMap& map);

}  // namespace qwsm
