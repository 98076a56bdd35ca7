// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/deskew.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace qwsm {
namespace {

// Neighbouring hits farther apart than this, in range, lie on two surfaces.
constexpr double kGapBetweenSurfaces_m = 0.15;

/// Where a reading lies, as seen from where the laser was at the first beam.
struct MovedHit {
  Eigen::Vector2d p_m;
  double range_m = 0.0;
  double beam = 0.0;  ///< Its bearing as a number of beams, of the scan at rest.
};

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

MovedHits MovedHitsOf(const LaserScan& scan,
                      const Pose2& T_first_last,
                      const LaserGeometry& still) {
  MovedHits hits(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (StateOf(scan.ranges_m[i], scan.geometry) != BeamState::kHit) continue;
    const double share = static_cast<double>(i) / static_cast<double>(scan.size() - 1);
    const Pose2 T_first_now{share * T_first_last.x_m,
                            share * T_first_last.y_m,
                            NormalizeAngle(share * T_first_last.theta_rad)};
    hits[i] = MovedHitOf(scan, i, T_first_now, still);
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

/// Reads the surface between two neighbouring hits along the beams between them.
void KeepBetween(const MovedHit& a, const MovedHit& b, LaserScan& still) {
  const auto [low, high] = std::minmax(a.beam, b.beam);
  for (double beam = std::ceil(low); beam <= high; beam += 1.0) {
    if (beam < 0.0) continue;
    const double bearing_rad = still.geometry.Bearing(static_cast<std::size_t>(beam));
    const Eigen::Vector2d ray(std::cos(bearing_rad), std::sin(bearing_rad));
    const double to_a = Cross(ray, a.p_m);
    const double to_b = Cross(ray, b.p_m);
    const double share = to_a == to_b ? 0.0 : to_a / (to_a - to_b);
    Keep(beam, (a.p_m + share * (b.p_m - a.p_m)).norm(), still);
  }
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
  if (scan.size() < 2 || T_first_last == Pose2{}) {
    return {.stamp = scan.stamp, .geometry = scan.geometry, .ranges_m = scan.ranges_m};
  }
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  LaserScan still{.stamp = scan.stamp,
                  .geometry = scan.geometry,
                  .ranges_m = std::vector<float>(scan.size(), kNothing)};
  still.geometry.bearing_step_rad +=
      static_cast<float>(T_first_last.theta_rad / static_cast<double>(scan.size() - 1));
  const MovedHits hits = MovedHitsOf(scan, T_first_last, still.geometry);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i]) continue;
    const bool goes_on = i + 1 < hits.size() && hits[i + 1] &&
                         std::abs(hits[i]->range_m - hits[i + 1]->range_m) < kGapBetweenSurfaces_m;
    if (goes_on) KeepBetween(*hits[i], *hits[i + 1], still);
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
