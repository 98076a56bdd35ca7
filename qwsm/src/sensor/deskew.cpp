// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/deskew.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace qwsm {
namespace {

// Neighbouring hits farther apart than this, in range, lie on two surfaces.
constexpr double kGapBetweenSurfaces_m = 0.15;
// Unless they go straight on: tangent of pi/8, by which a sparsely sampled wall may seem to turn.
constexpr double kTanOfStraight = std::numbers::sqrt2 - 1.0;
// What so many beams came to lie between was not seen as one surface by the two that hit it.
constexpr double kWidestGap_beams = 16.0;
// No robot is faster.
constexpr double kFastest_mps = 20.0;

/// Where a reading lies, as seen from where the laser was at the first beam.
struct MovedHit {
  Eigen::Vector2d p_m;
  double range_m = 0.0;
  double beam = 0.0;  ///< Its bearing as a number of beams, of the scan at rest.
};

// Odometry that began anew within a scan tells of no motion. Nor does any robot turn back half as
// fast as the mirror of its laser turns on.
bool IsMotionOfRobot(const LaserScan& scan, const Pose2& T_first_last) {
  const double farthest_m = kFastest_mps * Seconds(SweepOf(scan));
  const double seen_rad = scan.geometry.Bearing(scan.size() - 1) - scan.geometry.Bearing(0);
  const double turned_on_rad =
      std::copysign(T_first_last.theta_rad, T_first_last.theta_rad * seen_rad);
  return T_first_last.translation_m().norm() <= farthest_m &&
         turned_on_rad > -0.5 * std::abs(seen_rad);
}

using MovedHits = std::vector<std::optional<MovedHit>>;

MovedHit MovedHitOf(const LaserScan& scan,
                    std::size_t beam,
                    const Pose2& T_first_now,
                    const LaserGeometry& still) {
  const double range_m = static_cast<double>(scan.ranges_m[beam]);
  const double bearing_rad = scan.geometry.Bearing(beam);
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  const Eigen::Vector2d p_now_m(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
  const Eigen::Vector2d p_m = T_robot_laser.Inverse() * (T_first_now * (T_robot_laser * p_now_m));
  const double off_rad = NormalizeAngle(std::atan2(p_m.y(), p_m.x()) - still.Bearing(beam));
  return {
      .p_m = p_m,
      .range_m = p_m.norm(),
      .beam = static_cast<double>(beam) + off_rad / static_cast<double>(still.bearing_step_rad)};
}

// Part of a motion whose speed and turn rate stay the same: the robot goes along a circle.
Pose2 PartOf(const Pose2& motion, double share) {
  const double half_rad = 0.5 * motion.theta_rad;
  const double shorter = half_rad == 0.0 ? share : std::sin(share * half_rad) / std::sin(half_rad);
  const Pose2 turned{.theta_rad = (share - 1.0) * half_rad};
  const Eigen::Vector2d way_m = shorter * (turned * motion.translation_m());
  return {way_m.x(), way_m.y(), share * motion.theta_rad};
}

MovedHits MovedHitsOf(const LaserScan& scan,
                      const Pose2& T_first_last,
                      const LaserGeometry& still) {
  MovedHits hits(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (StateOf(scan.ranges_m[i], scan.geometry) != BeamState::kHit) continue;
    const double share = static_cast<double>(i) / static_cast<double>(scan.size() - 1);
    hits[i] = MovedHitOf(scan, i, PartOf(T_first_last, share), still);
  }
  return hits;
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The nearest surface hides the others.
void Keep(double beam, double range_m, LaserScan& still) {
  if (!(beam >= 0.0 && beam < static_cast<double>(still.size()))) return;
  float& kept_m = still.ranges_m[static_cast<std::size_t>(beam)];
  if (std::isnan(kept_m) || range_m < static_cast<double>(kept_m)) {
    kept_m = static_cast<float>(range_m);
  }
}

/// Range of the line through two hits along a beam; nothing where it does not meet the line.
std::optional<double> RangeOfLine(const MovedHit& a,
                                  const MovedHit& b,
                                  const LaserScan& still,
                                  std::size_t beam) {
  const double bearing_rad = still.geometry.Bearing(beam);
  const Eigen::Vector2d ray(std::cos(bearing_rad), std::sin(bearing_rad));
  const Eigen::Vector2d line_m = b.p_m - a.p_m;
  const double across = Cross(ray, line_m);
  if (across == 0.0) return std::nullopt;
  return Cross(a.p_m, line_m) / across;
}

/// Reads the surface between two neighbouring hits along the beams between them.
void KeepBetween(const MovedHit& a, const MovedHit& b, LaserScan& still) {
  const auto [low, high] = std::minmax(a.beam, b.beam);
  for (double beam = std::max(0.0, std::ceil(low)); beam <= high; beam += 1.0) {
    const auto range_m = RangeOfLine(a, b, still, static_cast<std::size_t>(beam));
    Keep(beam, range_m.value_or(a.range_m), still);
  }
}

/// Whether three neighbouring hits lie on a line, as on a wall that is seen at a grazing angle.
bool IsStraight(const MovedHits& hits, std::size_t middle) {
  if (middle == 0 || middle + 1 >= hits.size()) return false;
  if (!hits[middle - 1] || !hits[middle] || !hits[middle + 1]) return false;
  const Eigen::Vector2d before_m = hits[middle]->p_m - hits[middle - 1]->p_m;
  const Eigen::Vector2d after_m = hits[middle + 1]->p_m - hits[middle]->p_m;
  return std::abs(Cross(before_m, after_m)) <= kTanOfStraight * before_m.dot(after_m);
}

/// Whether a hit and the next one lie on one surface.
bool IsSurfaceBetween(const MovedHits& hits, std::size_t i) {
  if (i + 1 >= hits.size() || !hits[i] || !hits[i + 1]) return false;
  if (!(std::abs(hits[i]->beam - hits[i + 1]->beam) <= kWidestGap_beams)) return false;
  return std::abs(hits[i]->range_m - hits[i + 1]->range_m) < kGapBetweenSurfaces_m ||
         IsStraight(hits, i) || IsStraight(hits, i + 1);
}

/// Readings that are no hits have no place: they stay with their beams where no hit came to lie.
void KeepWhatCannotMove(const LaserScan& scan, LaserScan& still) {
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool is_free = std::isnan(still.ranges_m[i]);
    if (is_free && StateOf(scan.ranges_m[i], scan.geometry) != BeamState::kHit) {
      still.ranges_m[i] = scan.ranges_m[i];
    }
  }
}

}  // namespace

LaserScan Deskewed(const LaserScan& scan, const Pose2& T_first_last) {
  LaserScan still = scan;
  still.sweep = {};
  still.deskewed_sweep = SweepOf(scan);
  if (scan.size() < 2 || T_first_last == Pose2{} || !IsMotionOfRobot(scan, T_first_last)) {
    return still;
  }
  std::ranges::fill(still.ranges_m, std::numeric_limits<float>::quiet_NaN());
  still.geometry.bearing_step_rad +=
      static_cast<float>(T_first_last.theta_rad / static_cast<double>(scan.size() - 1));
  const MovedHits hits = MovedHitsOf(scan, T_first_last, still.geometry);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (IsSurfaceBetween(hits, i)) KeepBetween(*hits[i], *hits[i + 1], still);
  }
  for (const std::optional<MovedHit>& hit : hits) {  // Ends of surfaces: the beam next to them.
    if (!hit) continue;
    const double beam = std::round(hit->beam);
    const bool is_beam = beam >= 0.0 && beam < static_cast<double>(still.size());
    if (is_beam && std::isnan(still.ranges_m[static_cast<std::size_t>(beam)])) {
      Keep(beam, hit->range_m, still);
    }
  }
  KeepWhatCannotMove(scan, still);
  return still;
}

}  // namespace qwsm
