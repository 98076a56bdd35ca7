// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace qwsm {
namespace {

constexpr double kQuarters = 4.0;

// Grows with the bearing from 0 to 4 quarters of a turn, without trigonometry.
double QuartersTo(const Eigen::Vector2d& p) {
  const double sum = std::abs(p.x()) + std::abs(p.y());
  const double slope = sum > 0.0 ? p.y() / sum : 0.0;
  if (p.x() < 0.0) return 2.0 - slope;
  return slope < 0.0 ? kQuarters + slope : slope;
}

// The inverse.
double BearingOf(double quarters) {
  const double quarter = std::floor(quarters);
  const double share = quarters - quarter;
  return 0.5 * std::numbers::pi * quarter + std::atan2(share, 1.0 - share);
}

// The middles of so many directions.
std::vector<double> BearingsOf(std::size_t directions) {
  const double width = kQuarters / static_cast<double>(directions);
  std::vector<double> bearings_rad(directions);
  for (std::size_t i = 0; i < directions; ++i) {
    bearings_rad[i] = BearingOf((static_cast<double>(i) + 0.5) * width);
  }
  return bearings_rad;
}

// How far all beams near a bearing went; 0 if one of them is missing or brought no echo.
float FreeTowards(const LaserScan& scan, double bearing_rad, int margin_beams) {
  const LaserGeometry& laser = scan.geometry;
  const double step_rad = static_cast<double>(laser.bearing_step_rad);
  // The middle of the scan is no jump of the angle.
  const double middle_rad = laser.Bearing(0) + 0.5 * step_rad * static_cast<double>(scan.size());
  const double from_first_rad =
      middle_rad + NormalizeAngle(bearing_rad - middle_rad) - laser.Bearing(0);
  const auto nearest = std::lround(from_first_rad / step_rad);
  if (nearest < margin_beams || nearest + margin_beams >= std::ssize(scan.ranges_m)) return 0.0F;
  float free_m = laser.range_max_m;
  for (auto beam = nearest - margin_beams; beam <= nearest + margin_beams; ++beam) {
    const float range_m = scan.ranges_m[static_cast<std::size_t>(beam)];
    if (StateOf(range_m, laser) != BeamState::kHit) return 0.0F;
    free_m = std::min(free_m, range_m);
  }
  return free_m;
}

}  // namespace

FreeSpaceFan::FreeSpaceFan(const LaserScan& scan,
                           const Pose2& T_map_robot,
                           const FreeSpaceOptions& options) {
  static const std::vector<double> kBearings_rad = BearingsOf(kDirections);
  const Pose2 T_map_laser = T_map_robot * scan.geometry.T_robot_laser;
  p_map_laser_m_ = T_map_laser.translation_m();
  R_laser_map_ = T_map_laser.Rotation().transpose();
  for (std::size_t i = 0; i < kDirections; ++i) {
    free_m_[i] = FreeTowards(scan, kBearings_rad[i], options.margin_beams) -
                 static_cast<float>(options.margin_m);
  }
}

bool FreeSpaceFan::SawThrough(const Eigen::Vector2d& p_map_m) const {
  const Eigen::Vector2d p_laser = R_laser_map_ * (p_map_m - p_map_laser_m_);
  const double direction = QuartersTo(p_laser) / kQuarters * static_cast<double>(kDirections);
  const double free_m =
      static_cast<double>(free_m_[static_cast<std::size_t>(direction) % kDirections]);
  return free_m > 0.0 && p_laser.squaredNorm() < free_m * free_m;
}

void FreeSpace::Add(const LaserScan& scan, const Pose2& T_map_robot) {
  fans_.emplace_back(scan, T_map_robot, options_);
  if (fans_.size() > static_cast<std::size_t>(options_.scans)) fans_.pop_front();
}

bool FreeSpace::SawThrough(const Eigen::Vector2d& p_map_m) const {
  return std::ranges::any_of(
      fans_, [&p_map_m](const FreeSpaceFan& fan) { return fan.SawThrough(p_map_m); });
}

std::vector<ScanPoint> FreeSpace::WithoutMoving(std::span<const ScanPoint> points,
                                                const Pose2& T_map_robot) const {
  std::vector<ScanPoint> still;
  still.reserve(points.size());
  const Eigen::Matrix2d R_map_robot = T_map_robot.Rotation();
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p_map = R_map_robot * point.p_robot_m + T_map_robot.translation_m();
    if (!SawThrough(p_map)) still.push_back(point);
  }
  const auto moving = static_cast<double>(points.size() - still.size());
  if (moving > options_.max_moving_share * static_cast<double>(points.size())) {
    still.assign(points.begin(), points.end());
  }
  return still;
}

LaserScan FreeSpace::WithoutMoving(LaserScan scan,
                                   std::span<const ScanPoint> points,
                                   const Pose2& T_map_robot) const {
  const std::vector<ScanPoint> still = WithoutMoving(points, T_map_robot);
  auto next = still.begin();
  for (const ScanPoint& point : points) {
    if (next != still.end() && next->beam == point.beam) {
      ++next;
    } else {
      scan.ranges_m[point.beam] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return scan;
}

}  // namespace qwsm
