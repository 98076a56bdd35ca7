// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/scan_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "qwsm/geometry/moments.hpp"

namespace qwsm {
namespace {

constexpr double kNormalReachSpacings = 2.2;  // Normals need so many, where beams are far apart.
constexpr double kGap_m = 0.15;               // Neighbouring points further apart, and
constexpr double kGapSpacings = 6.0;          // more beam spacings apart, lie on two surfaces.
constexpr double kGapOfMean_m = 0.03;         // The same for points of which the mean is wanted.
constexpr double kGapOfMeanSpacings = 3.0;
constexpr double kMaxRoughness_m = 0.05;  // A wall is flatter than this.
constexpr std::size_t kMaxBeamsAway = 2;  // Between neighbours, for a failed reading.
constexpr double kInFront_m = 0.3;        // Nearer than its neighbours by this: another object.
constexpr double kTanOfMaxTurn =
    std::numbers::sqrt2 - 1.0;       // pi/8: of a straight surface, sparsely sampled.
constexpr double kMaxAspect = 0.25;  // Across over along, as standard deviations.

// How far a surface is followed from one of its points.
struct SurfaceLimits {
  double reach_m;  // From the point;
  double gap_m;    // and between two neighbours.
};

// Walks from points[center] along its surface in one direction and returns the last point within
// the limits.
std::size_t EndOfSurface(std::span<const ScanPoint> points,
                         std::size_t center,
                         const SurfaceLimits& limits,
                         bool forward) {
  const Eigen::Vector2d& p_center = points[center].p_robot_m;
  std::size_t last = center;
  while (forward ? last + 1 < points.size() : last > 0) {
    const std::size_t next = forward ? last + 1 : last - 1;
    const Eigen::Vector2d& p = points[next].p_robot_m;
    if ((p - points[last].p_robot_m).squaredNorm() > limits.gap_m * limits.gap_m) break;
    if ((p - p_center).squaredNorm() > limits.reach_m * limits.reach_m) break;
    last = next;
  }
  return last;
}

std::span<const ScanPoint> SurfaceAround(std::span<const ScanPoint> points,
                                         std::size_t center,
                                         const SurfaceLimits& limits) {
  const std::size_t first = EndOfSurface(points, center, limits, false);
  const std::size_t last = EndOfSurface(points, center, limits, true);
  return points.subspan(first, last - first + 1);
}

// A reading half on an edge and half on what is behind it must not draw its neighbours' means
// along, so these are of what lies close together.
Eigen::Vector2d MeanAround(std::span<const ScanPoint> points, std::size_t i) {
  const double gap_m = std::max(kGapOfMean_m, kGapOfMeanSpacings * points[i].arc_m);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  const auto around = SurfaceAround(points, i, {.reach_m = kSurfaceReach_m, .gap_m = gap_m});
  for (const ScanPoint& p : around) sum += p.p_robot_m;
  return sum / static_cast<double>(around.size());
}

Eigen::Vector2d NormalOf(std::span<const ScanPoint> neighbors) {
  const Eigen::Vector2d origin = neighbors.front().p_robot_m;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector3d sum_of_squares = Eigen::Vector3d::Zero();  // xx, xy, yy.
  for (const ScanPoint& p : neighbors) {
    const Eigen::Vector2d d = p.p_robot_m - origin;
    sum += d;
    sum_of_squares += Eigen::Vector3d(d.x() * d.x(), d.x() * d.y(), d.y() * d.y());
  }
  const double scale = 1.0 / static_cast<double>(neighbors.size());
  const Eigen::Vector2d mean = scale * sum;
  const PrincipalAxes axes = PrincipalAxesOf(scale * sum_of_squares(0) - mean.x() * mean.x(),
                                             scale * sum_of_squares(1) - mean.x() * mean.y(),
                                             scale * sum_of_squares(2) - mean.y() * mean.y());
  const bool is_line = axes.minor_m2 < kMaxRoughness_m * kMaxRoughness_m &&
                       axes.minor_m2 < kMaxAspect * kMaxAspect * axes.major_m2;
  return is_line ? axes.minor_axis : Eigen::Vector2d::Zero();
}

// Distance from points[i] to the next sample of its surface. What stands in front of what its
// neighbouring beams hit is an object no wider than a beam; the end of a wall that is seen at a
// grazing angle is not, though its neighbours are as far away.
double SurfaceSpacing(std::span<const ScanPoint> points, std::size_t i) {
  const ScanPoint& p = points[i];
  double nearest_m = std::numeric_limits<double>::infinity();
  bool is_in_front = true;
  const auto look_at = [&](const ScanPoint& neighbor, std::size_t beams_away) {
    if (beams_away > kMaxBeamsAway) return;
    nearest_m = std::min(nearest_m, (neighbor.p_robot_m - p.p_robot_m).norm());
    if (neighbor.range_m < p.range_m + kInFront_m) is_in_front = false;
  };
  if (i > 0) look_at(points[i - 1], p.beam - points[i - 1].beam);
  if (i + 1 < points.size()) look_at(points[i + 1], points[i + 1].beam - p.beam);
  return is_in_front ? p.arc_m : std::max(p.arc_m, nearest_m);
}

// Tangent through the neighbouring beams' points, however far they are, if the surface goes
// straight on there. Wanted at grazing incidence, where samples are sparse.
Eigen::Vector2d NormalOfSparse(std::span<const ScanPoint> points, std::size_t i) {
  if (i == 0 || i + 1 >= points.size()) return Eigen::Vector2d::Zero();
  if (points[i + 1].beam - points[i - 1].beam > 2 * kMaxBeamsAway) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d before = points[i].p_robot_m - points[i - 1].p_robot_m;
  const Eigen::Vector2d after = points[i + 1].p_robot_m - points[i].p_robot_m;
  const double sine = before.x() * after.y() - before.y() * after.x();
  if (std::abs(sine) > kTanOfMaxTurn * before.dot(after)) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d tangent = (before + after).normalized();
  return {-tangent.y(), tangent.x()};
}

Eigen::Vector2d NormalTowardsLaser(std::span<const ScanPoint> points, std::size_t i) {
  const double arc_m = points[i].arc_m;
  const auto around =
      SurfaceAround(points,
                    i,
                    {.reach_m = std::max(kSurfaceReach_m, kNormalReachSpacings * arc_m),
                     .gap_m = std::max(kGap_m, kGapSpacings * arc_m)});
  const Eigen::Vector2d normal = around.size() >= 3 ? NormalOf(around) : NormalOfSparse(points, i);
  return normal.dot(points[i].beam_robot) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

std::vector<ScanPoint> ToPoints(const LaserScan& scan) {
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  const double step_rad = std::abs(static_cast<double>(scan.geometry.bearing_step_rad));
  std::vector<ScanPoint> points;
  points.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (StateOf(scan.ranges_m[beam], scan.geometry) != BeamState::kHit) continue;
    const double range_m = static_cast<double>(scan.ranges_m[beam]);
    const double bearing_robot_rad = T_robot_laser.theta_rad + scan.geometry.Bearing(beam);
    const Eigen::Vector2d beam_robot(std::cos(bearing_robot_rad), std::sin(bearing_robot_rad));
    points.push_back({.p_robot_m = T_robot_laser.translation_m() + range_m * beam_robot,
                      .beam_robot = beam_robot,
                      .normal_robot = Eigen::Vector2d::Zero(),
                      .to_mean_robot_m = Eigen::Vector2d::Zero(),
                      .range_m = range_m,
                      .arc_m = range_m * step_rad,
                      .spacing_m = 0.0,
                      .beam = beam});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].spacing_m = SurfaceSpacing(points, i);
    points[i].normal_robot = NormalTowardsLaser(points, i);
    points[i].to_mean_robot_m = MeanAround(points, i) - points[i].p_robot_m;
  }
  return points;
}

ScanPoint operator*(const Pose2& T_other_robot, const ScanPoint& point) {
  const Eigen::Matrix2d R_other_robot = T_other_robot.Rotation();
  ScanPoint seen = point;
  seen.p_robot_m = R_other_robot * point.p_robot_m + T_other_robot.translation_m();
  seen.beam_robot = R_other_robot * point.beam_robot;
  seen.normal_robot = R_other_robot * point.normal_robot;
  seen.to_mean_robot_m = R_other_robot * point.to_mean_robot_m;
  return seen;
}

std::vector<ScanPoint> ThinOut(std::span<const ScanPoint> points, double spacing_m) {
  std::vector<ScanPoint> thinned;
  thinned.reserve(points.size());
  for (const ScanPoint& point : points) {
    if (!thinned.empty() &&
        (point.p_robot_m - thinned.back().p_robot_m).squaredNorm() < spacing_m * spacing_m) {
      continue;
    }
    thinned.push_back(point);
  }
  return thinned;
}

std::vector<Eigen::Vector2d> PositionsOf(std::span<const ScanPoint> points) {
  std::vector<Eigen::Vector2d> positions_robot_m;
  positions_robot_m.reserve(points.size());
  for (const ScanPoint& point : points) positions_robot_m.push_back(point.p_robot_m);
  return positions_robot_m;
}

}  // namespace qwsm
