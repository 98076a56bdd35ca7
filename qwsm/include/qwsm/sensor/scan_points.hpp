// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// How much of a surface around a point is taken together to tell where and how it lies.
inline constexpr double kSurfaceReach_m = 0.12;

/// A surface point that a scan measured, in the robot's frame.
struct ScanPoint {
  Eigen::Vector2d p_robot_m;
  Eigen::Vector2d beam_robot;  ///< Unit vector from the laser to the point.
  /// Unit normal of the surface, towards the laser, by a line through the neighbouring beams'
  /// points; zero where they are no line (a corner, an edge, a lone point).
  Eigen::Vector2d normal_robot = Eigen::Vector2d::Zero();
  /// Vector from this point to the mean of the points of its surface within kSurfaceReach_m.
  Eigen::Vector2d to_mean_robot_m = Eigen::Vector2d::Zero();
  /// The same within half of that reach.
  Eigen::Vector2d to_mean_near_robot_m = Eigen::Vector2d::Zero();
  double range_m = 0.0;
  double arc_m = 0.0;  ///< Distance between this beam and the next one at this range.
  /// Distance to the next sample of the same surface; for a small object as `arc_m`.
  double spacing_m = 0.0;
  std::size_t beam = 0;  ///< Index of the beam in its scan.
};

/// Returns the points of all beams that hit something.
std::vector<ScanPoint> ToPoints(const LaserScan& scan);

/// Returns the same points for whoever asks where they lie, and not what their neighbours tell of
/// them: without normal, mean and spacing, which are most of the work.
std::vector<ScanPoint> HitsOf(const LaserScan& scan);

/// Returns the point as another robot pose sees it.
ScanPoint operator*(const RigidTransform2& T_other_robot, const ScanPoint& point);

/// How much of points[i] is news beside the point before it: neighbours so near to each other show
/// the same of a surface, or of somebody who stands close to the laser. From 0.01 to 1.
double NewsOf(std::span<const ScanPoint> points, std::size_t i);
/// The sum over all points: by how many that lie apart a scan shows as much.
double CountNews(std::span<const ScanPoint> points);

/// Calls visit(const ScanPoint&) for points at least `spacing_m` apart, walking along the scan: near
/// surfaces, on which beams are dense, count no more than far ones.
template <class Visit>
void ForEachApart(std::span<const ScanPoint> points, double spacing_m, Visit visit) {
  const ScanPoint* last = nullptr;
  for (const ScanPoint& point : points) {
    if (last != nullptr &&
        (point.p_robot_m - last->p_robot_m).squaredNorm() < spacing_m * spacing_m) {
      continue;
    }
    visit(point);
    last = &point;
  }
}

/// Returns those points.
std::vector<ScanPoint> ThinOut(std::span<const ScanPoint> points, double spacing_m);
/// Thins out at wider and wider spacing until no more than so many points are left. @pre most > 0
std::vector<ScanPoint> ThinOut(std::span<const ScanPoint> points,
                               double spacing_m,
                               std::size_t most);

/// Returns the positions of points in the robot's frame.
std::vector<Eigen::Vector2d> PositionsOf(std::span<const ScanPoint> points);

}  // namespace qwsm
