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
constexpr double kGapOfMean_m = 0.03;  // For points of which the mean is wanted, gaps are narrower.
constexpr double kGapOfMeanSpacings = 3.0;
// Points this far apart share nothing: so far are those of a beam per degree, 1.9 m away.
constexpr double kAllNews_m = 0.033;
constexpr double kLeastNews = 0.01;
constexpr double kMaxRoughness_m = 0.05;  // A wall is flatter than this.
constexpr std::size_t kMaxBeamsAway = 2;  // Between neighbours, for a failed reading.
constexpr double kInFront_m = 0.3;        // Nearer than its neighbours by this: another object.
// Tangent of pi/8, by which a straight surface that is sparsely sampled may seem to turn.
constexpr double kTanOfMaxTurn = std::numbers::sqrt2 - 1.0;
constexpr double kMaxAspect = 0.25;  // Across over along, as standard deviations.

// How far a surface is followed from one of its points, as squared distances.
struct SurfaceLimits {
  double reach_m2;  // From the point.
  double gap_m2;    // Between two neighbours.

  bool Hold(double distance_m2, double to_last_m2) const {
    return distance_m2 <= reach_m2 && to_last_m2 <= gap_m2;
  }
};

double Squared(double value) { return value * value; }

// The mean of points of one surface, as seen from one of them.
struct MeanAround {
  int count = 1;  // The one itself.
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();

  void Add(const Eigen::Vector2d& offset_m) {
    ++count;
    sum_m += offset_m;
  }
  Eigen::Vector2d mean_m() const { return sum_m / count; }
};

// Where they lie about it, too.
struct PointsAround : MeanAround {
  Eigen::Vector2d squares_m2 = Eigen::Vector2d::Zero();  // xx, yy
  double xy_m2 = 0.0;

  void Add(const Eigen::Vector2d& offset_m) {
    MeanAround::Add(offset_m);
    squares_m2 += offset_m.cwiseProduct(offset_m);
    xy_m2 += offset_m.x() * offset_m.y();
  }
  PrincipalAxes axes() const {
    const double scale = 1.0 / count;
    const Eigen::Vector2d mean = scale * sum_m;
    return PrincipalAxesOf(scale * squares_m2.x() - mean.x() * mean.x(),
                           scale * xy_m2 - mean.x() * mean.y(),
                           scale * squares_m2.y() - mean.y() * mean.y());
  }
};

// The points of a scan, and the gaps from each to the next one.
struct PointRow {
  explicit PointRow(std::span<const ScanPoint> points) : p_m(PositionsOf(points)) {
    gaps_m2.reserve(p_m.size());
    for (std::size_t i = 1; i < p_m.size(); ++i) {
      gaps_m2.push_back((p_m[i] - p_m[i - 1]).squaredNorm());
    }
  }

  std::vector<Eigen::Vector2d> p_m;
  std::vector<double> gaps_m2;  // Squared.
};

// What lies about a point of a scan: its surface, of which the normal is wanted, and what of it
// lies close together, of which the means are. For a reading half on an edge and half on what is
// behind it must not draw its neighbours' means along.
class SurfaceAround {
 public:
  SurfaceAround(const PointRow& row, std::size_t center, double arc_m)
      : row_(row), center_(static_cast<std::ptrdiff_t>(center)) {
    const SurfaceLimits limits{
        .reach_m2 = Squared(std::max(kSurfaceReach_m, kNormalReachSpacings * arc_m)),
        .gap_m2 = Squared(std::max(kGap_m, kGapSpacings * arc_m))};
    // Nowhere wider.
    const SurfaceLimits close_limits{
        .reach_m2 = Squared(kSurfaceReach_m),
        .gap_m2 = Squared(std::max(kGapOfMean_m, kGapOfMeanSpacings * arc_m))};
    const SurfaceLimits near_limits{.reach_m2 = Squared(0.5 * kSurfaceReach_m),
                                    .gap_m2 = close_limits.gap_m2};
    const std::ptrdiff_t near_below = Follow<-1>(center_ - 1, near_limits);
    near_ = surface_;
    const std::ptrdiff_t close_below = Follow<-1>(near_below, close_limits);
    close_ = surface_;
    const std::ptrdiff_t below = Follow<-1>(close_below, limits);
    const std::ptrdiff_t near_above = Follow<1>(center_ + 1, near_limits);
    AddAbove(near_above, near_);
    const std::ptrdiff_t close_above = Follow<1>(near_above, close_limits);
    if (below == close_below) {
      close_ = surface_;
    } else {
      AddAbove(close_above, close_);
    }
    Follow<1>(close_above, limits);
  }

  const PointsAround& surface() const { return surface_; }
  const MeanAround& close() const { return close_; }
  const MeanAround& near() const { return near_; }

 private:
  // Adds points on the way outwards as long as the surface goes on. @return the one after the last
  template <int kStep>
  std::ptrdiff_t Follow(std::ptrdiff_t from, const SurfaceLimits& limits) {
    PointsAround around = surface_;  // In registers.
    std::ptrdiff_t i = from;
    for (; i >= 0 && i < std::ssize(row_.p_m); i += kStep) {
      const Eigen::Vector2d offset = OffsetOf(i);
      const auto gap = static_cast<std::size_t>(kStep < 0 ? i : i - 1);
      if (!limits.Hold(offset.squaredNorm(), row_.gaps_m2[gap])) break;
      around.Add(offset);
    }
    surface_ = around;
    return i;
  }

  void AddAbove(std::ptrdiff_t end, MeanAround& to) const {
    for (std::ptrdiff_t i = center_ + 1; i < end; ++i) to.Add(OffsetOf(i));
  }

  Eigen::Vector2d OffsetOf(std::ptrdiff_t i) const {
    return row_.p_m[static_cast<std::size_t>(i)] - row_.p_m[static_cast<std::size_t>(center_)];
  }

  const PointRow& row_;
  const std::ptrdiff_t center_;
  PointsAround surface_;
  MeanAround close_;
  MeanAround near_;  // Within half the reach.
};

Eigen::Vector2d NormalOf(const PointsAround& neighbors) {
  const PrincipalAxes axes = neighbors.axes();
  const bool is_line = axes.minor_m2 < kMaxRoughness_m * kMaxRoughness_m &&
                       axes.minor_m2 < kMaxAspect * kMaxAspect * axes.major_m2;
  return is_line ? axes.minor_axis : Eigen::Vector2d::Zero();
}

// Distance from points[i] to the next sample of its surface. What stands in front of what its
// neighbouring beams hit is an object no wider than a beam; the end of a wall that is seen at a
// grazing angle is not, though its neighbours are as far away.
double SurfaceSpacing(std::span<const ScanPoint> points,
                      std::span<const double> gaps_m2,
                      std::size_t i) {
  const ScanPoint& p = points[i];
  double nearest_m2 = std::numeric_limits<double>::infinity();
  bool is_in_front = true;
  const auto look_at = [&](const ScanPoint& neighbor, std::size_t beams_away, double gap_m2) {
    if (beams_away > kMaxBeamsAway) return;
    nearest_m2 = std::min(nearest_m2, gap_m2);
    if (neighbor.range_m < p.range_m + kInFront_m) is_in_front = false;
  };
  if (i > 0) look_at(points[i - 1], p.beam - points[i - 1].beam, gaps_m2[i - 1]);
  if (i + 1 < points.size()) look_at(points[i + 1], points[i + 1].beam - p.beam, gaps_m2[i]);
  return is_in_front ? p.arc_m : std::max(p.arc_m, std::sqrt(nearest_m2));
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

Eigen::Vector2d TowardsLaser(const Eigen::Vector2d& normal, const Eigen::Vector2d& beam) {
  return normal.dot(beam) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

double NewsOf(std::span<const ScanPoint> points, std::size_t i) {
  if (i == 0) return 1.0;
  const double apart_m2 = (points[i].p_robot_m - points[i - 1].p_robot_m).squaredNorm();
  if (apart_m2 >= Squared(kAllNews_m)) return 1.0;
  return std::max(kLeastNews, std::sqrt(apart_m2) / kAllNews_m);
}

double CountNews(std::span<const ScanPoint> points) {
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) count += NewsOf(points, i);
  return count;
}

std::vector<ScanPoint> HitsOf(const LaserScan& scan) {
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  const double step_rad = static_cast<double>(scan.geometry.bearing_step_rad);
  const double first_rad = T_robot_laser.theta_rad + scan.geometry.Bearing(0);
  const Eigen::Matrix2d step = Pose2{.theta_rad = step_rad}.Rotation();
  Eigen::Vector2d beam_robot(std::cos(first_rad), std::sin(first_rad));
  std::vector<ScanPoint> points;
  points.reserve(scan.size());
  for (std::size_t beam = 0; beam < scan.size(); ++beam, beam_robot = step * beam_robot) {
    if (StateOf(scan.ranges_m[beam], scan.geometry) != BeamState::kHit) continue;
    const double range_m = static_cast<double>(scan.ranges_m[beam]);
    points.push_back({.p_robot_m = T_robot_laser.translation_m() + range_m * beam_robot,
                      .beam_robot = beam_robot,
                      .normal_robot = Eigen::Vector2d::Zero(),
                      .to_mean_robot_m = Eigen::Vector2d::Zero(),
                      .to_mean_near_robot_m = Eigen::Vector2d::Zero(),
                      .range_m = range_m,
                      .arc_m = range_m * std::abs(step_rad),
                      .spacing_m = 0.0,
                      .beam = beam});
  }
  return points;
}

std::vector<ScanPoint> ToPoints(const LaserScan& scan) {
  std::vector<ScanPoint> points = HitsOf(scan);
  const PointRow row(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SurfaceAround around(row, i, points[i].arc_m);
    points[i].spacing_m = SurfaceSpacing(points, row.gaps_m2, i);
    points[i].normal_robot = TowardsLaser(
        around.surface().count >= 3 ? NormalOf(around.surface()) : NormalOfSparse(points, i),
        points[i].beam_robot);
    points[i].to_mean_robot_m = around.close().mean_m();
    points[i].to_mean_near_robot_m = around.near().mean_m();
  }
  return points;
}

ScanPoint operator*(const RigidTransform2& T_other_robot, const ScanPoint& point) {
  ScanPoint seen = point;
  seen.p_robot_m = T_other_robot * point.p_robot_m;
  seen.beam_robot = T_other_robot.R_a_b * point.beam_robot;
  seen.normal_robot = T_other_robot.R_a_b * point.normal_robot;
  seen.to_mean_robot_m = T_other_robot.R_a_b * point.to_mean_robot_m;
  seen.to_mean_near_robot_m = T_other_robot.R_a_b * point.to_mean_near_robot_m;
  return seen;
}

std::vector<ScanPoint> ThinOut(std::span<const ScanPoint> points, double spacing_m) {
  std::vector<ScanPoint> thinned;
  thinned.reserve(points.size());
  ForEachApart(points, spacing_m, [&](const ScanPoint& point) { thinned.push_back(point); });
  return thinned;
}

std::vector<ScanPoint> ThinOut(std::span<const ScanPoint> points,
                               double spacing_m,
                               std::size_t most) {
  constexpr double kSparser = 1.3;
  std::vector<ScanPoint> thinned = ThinOut(points, spacing_m);
  while (thinned.size() > most) thinned = ThinOut(points, spacing_m *= kSparser);
  return thinned;
}

std::vector<Eigen::Vector2d> PositionsOf(std::span<const ScanPoint> points) {
  std::vector<Eigen::Vector2d> positions_robot_m;
  positions_robot_m.reserve(points.size());
  for (const ScanPoint& point : points) positions_robot_m.push_back(point.p_robot_m);
  return positions_robot_m;
}

}  // namespace qwsm
