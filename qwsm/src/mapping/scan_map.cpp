// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_map.hpp"

#include <utility>

namespace qwsm {

ScanMap::ScanMap(const ScanMapOptions& options) : options_(options), surfaces_(options.surfaces) {}

ScanId ScanMap::Insert(const LaserScan& scan,
                       std::span<const ScanPoint> points,
                       const UncertainPose2& map_robot) {
  return Add(Prepare(scan, points, map_robot));
}

MapAddition ScanMap::Prepare(const LaserScan& scan,
                             std::span<const ScanPoint> points,
                             const UncertainPose2& map_robot) const {
  MapAddition addition{.scan = scan, .map_robot = map_robot, .points = {}};
  addition.points.reserve(points.size());
  const FrameCovariance covariance = FrameCovariance::Of(map_robot);
  const Eigen::Matrix2d R_map_robot = map_robot.T_a_b.Rotation();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p_map = map_robot.T_a_b * points[i].p_robot_m;
    if (options_.insertion == InsertionRule::kNewSurface && !IsNewSurface(p_map)) continue;
    addition.points.push_back({.p_map_m = p_map,
                               .normal_map = R_map_robot * points[i].normal_robot,
                               .spacing_m = points[i].spacing_m,
                               .drift_m2 = covariance.PositionVariance(p_map)});
  }
  return addition;
}

ScanId ScanMap::Add(MapAddition addition) {
  const auto id = static_cast<ScanId>(scans_.size());
  // Only now: the points of one scan do not crowd each other out.
  for (const MapPoint& point : addition.points) surfaces_.Insert(point, id);
  covariances_.push_back(FrameCovariance::Of(addition.map_robot));
  scans_.push_back({.id = id, .scan = std::move(addition.scan), .map_robot = addition.map_robot});
  return id;
}

bool ScanMap::IsNewSurface(const Eigen::Vector2d& p_map_m) const {
  int crowd = 0;
  surfaces_.quadtree().ForEachInRadius(
      p_map_m, options_.crowd_radius_m, [&crowd](PointId, const Eigen::Vector2d&) { ++crowd; });
  return crowd < options_.crowd_points;
}

void ScanMap::ForgetPoints() { surfaces_ = SurfaceMap(options_.surfaces); }

FrameCovariance ScanMap::CovarianceAround(std::span<const Eigen::Vector2d> points_map_m,
                                          double max_distance_m) const {
  FrameCovariance mean;
  int count = 0;
  for (const Eigen::Vector2d& p_map : points_map_m) {
    const auto nearest = surfaces_.quadtree().Nearest(p_map, max_distance_m);
    if (!nearest) continue;
    mean.about_origin += covariances_[surfaces_.quadtree().Scan(nearest->id)].about_origin;
    ++count;
  }
  if (count > 0) return {mean.about_origin / count};
  return covariances_.empty() ? mean : covariances_.back();
}

}  // namespace qwsm
