// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_map.hpp"

#include <algorithm>
#include <utility>

namespace qwsm {
namespace {

constexpr double kReferenceReach_m = 0.2;    // Stored points this near are what a scan lies on.
constexpr double kReferenceSpacing_m = 0.3;  // Enough to tell which scans they came from.
// Part of what two scans on the same surfaces add to the error is the same: that of the surfaces'
// shapes. Measured by the NEES of many simulated drives (evaluate_covariance).
constexpr double kIndependentShare = 0.55;

bool IsNewSurface(const SurfaceMap& surfaces,
                  const Eigen::Vector2d& p_map_m,
                  const ScanMapOptions& options) {
  return surfaces.quadtree().CountInRadius(p_map_m,
                                           options.density_radius_m,
                                           options.max_density_points) < options.max_density_points;
}

}  // namespace

std::vector<MapPoint> PointsToStore(const SurfaceMap& surfaces,
                                    std::span<const ScanPoint> points,
                                    const UncertainPose2& map_robot,
                                    const ScanMapOptions& options) {
  std::vector<MapPoint> stored;
  stored.reserve(points.size());
  const FrameCovariance covariance = FrameCovariance::Of(map_robot);
  const RigidTransform2 to_map(map_robot.T_a_b);
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p_map = to_map * point.p_robot_m;
    if (options.insertion == InsertionRule::kNewSurface &&
        !IsNewSurface(surfaces, p_map, options)) {
      continue;
    }
    stored.push_back({.p_map_m = p_map,
                      .normal_map = to_map.R_a_b * point.normal_robot,
                      .spacing_m = point.spacing_m,
                      .drift_m2 = covariance.PositionVariance(p_map)});
  }
  return stored;
}

ScanMap::ScanMap(const ScanMapOptions& options) : options_(options), surfaces_(options.surfaces) {}

ScanId ScanMap::Insert(LaserScan scan,
                       std::span<const ScanPoint> points,
                       const UncertainPose2& map_robot) {
  return Add(Prepare(std::move(scan), points, map_robot));
}

ScanId ScanMap::Insert(LaserScan scan, const UncertainPose2& map_robot) {
  const std::vector<ScanPoint> points = ToPoints(scan);
  return Insert(std::move(scan), points, map_robot);
}

MapAddition ScanMap::Prepare(LaserScan scan,
                             std::span<const ScanPoint> points,
                             const UncertainPose2& map_robot) const {
  MapAddition addition{
      .scan = std::move(scan), .map_robot = map_robot, .points = {}, .own_error = {}};
  if (!empty()) {
    addition.own_error =
        FrameCovariance::Of(Without(CovarianceUnder(points, map_robot.T_a_b), map_robot));
  }
  addition.points = PointsToStore(surfaces_, points, map_robot, options_);
  return addition;
}

ScanId ScanMap::Add(MapAddition addition) {
  const auto id = static_cast<ScanId>(scans_.size());
  // Only now: the density that keeps points out is that of older scans.
  for (const MapPoint& point : addition.points) surfaces_.Insert(point, id);
  const FrameCovariance own{kIndependentShare * addition.own_error.about_origin};
  errors_.push_back({.shared = FrameCovariance::Of(Without(own, addition.map_robot)), .own = own});
  scans_.push_back({.id = id, .scan = std::move(addition.scan), .map_robot = addition.map_robot});
  return id;
}

void ScanMap::ForgetPoints() { surfaces_ = SurfaceMap(options_.surfaces); }

FrameCovariance ScanMap::CovarianceUnder(std::span<const ScanPoint> points,
                                         const Pose2& T_map_robot,
                                         double max_drift_m2) const {
  const RigidTransform2 to_map(T_map_robot);
  const std::uint8_t max_drift_code = LikelihoodPyramid::DriftCode(max_drift_m2);
  std::vector<ScanId> under;
  ForEachApart(points, kReferenceSpacing_m, [&](const ScanPoint& point) {
    const auto nearest = surfaces_.quadtree().Nearest(to_map * point.p_robot_m, kReferenceReach_m);
    if (nearest && surfaces_.DriftCode(nearest->id) <= max_drift_code) {
      under.push_back(surfaces_.quadtree().Scan(nearest->id));
    }
  });
  if (under.empty() && !empty()) under.push_back(scans_.back().id);
  std::ranges::sort(under);
  FrameCovariance mean;
  for (auto scan = under.begin(); scan != under.end();) {
    const auto next = std::ranges::upper_bound(scan, under.end(), *scan);
    const double weight = static_cast<double>(next - scan) / static_cast<double>(under.size());
    const ScanError& error = errors_[*scan];
    mean.about_origin +=
        weight * error.shared.about_origin + weight * weight * error.own.about_origin;
    scan = next;
  }
  return mean;
}

ScanMap MapOf(std::vector<RelevantScan> scans, const ScanMapOptions& options) {
  ScanMap map(options);
  for (RelevantScan& relevant : scans) {
    map.Insert(std::move(relevant.scan), relevant.map_robot);
  }
  return map;
}

std::vector<Eigen::Vector2d> PathOf(const ScanMap& map) {
  std::vector<Eigen::Vector2d> path_m;
  path_m.reserve(map.scans().size());
  for (const RelevantScan& scan : map.scans()) {
    path_m.push_back(scan.map_robot.T_a_b.translation_m());
  }
  return path_m;
}

}  // namespace qwsm
