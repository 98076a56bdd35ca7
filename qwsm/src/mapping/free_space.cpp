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
inline float QuartersTo(float x, float y) {
  const float slope = y / (std::abs(x) + std::abs(y) + std::numeric_limits<float>::min());
  return 3.0F + std::copysign(1.0F, x) * (1.0F + slope);
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

// For each beam how far it and all beams near it went; 0 if one of them is missing or brought no
// echo.
std::vector<float> FreeAlongBeams(const LaserScan& scan, int margin_beams) {
  const auto beams = std::ssize(scan.ranges_m);
  std::vector<float> hits_m(scan.ranges_m);
  for (float& range_m : hits_m) {
    if (StateOf(range_m, scan.geometry) != BeamState::kHit) range_m = 0.0F;
  }
  std::vector<float> free_m(hits_m.size(), 0.0F);
  for (std::ptrdiff_t beam = margin_beams; beam + margin_beams < beams; ++beam) {
    const auto around = hits_m.begin() + beam;
    free_m[static_cast<std::size_t>(beam)] =
        *std::min_element(around - margin_beams, around + margin_beams + 1);
  }
  return free_m;
}

// The beam nearest to a bearing, which may lie beside all of them.
std::ptrdiff_t NearestBeam(const LaserScan& scan, double bearing_rad) {
  const double step_rad = static_cast<double>(scan.geometry.bearing_step_rad);
  const double first_rad = scan.geometry.Bearing(0);
  // The middle of the scan is no jump of the angle.
  const double middle_rad = first_rad + 0.5 * step_rad * static_cast<double>(scan.size());
  return std::lround((middle_rad + NormalizeAngle(bearing_rad - middle_rad) - first_rad) /
                     step_rad);
}

}  // namespace

FreeRangeImage::FreeRangeImage(const LaserScan& scan,
                               const Pose2& T_map_robot,
                               const FreeSpaceOptions& options) {
  static const std::vector<double> kBearings_rad = BearingsOf(kDirections);
  const Pose2 T_map_laser = T_map_robot * scan.geometry.T_robot_laser;
  T_laser_map_ = T_map_laser.Inverse();
  const std::vector<float> free_m = FreeAlongBeams(scan, options.margin_beams);
  for (std::size_t i = 0; i < kDirections; ++i) {
    const std::ptrdiff_t beam = NearestBeam(scan, kBearings_rad[i]);
    if (beam < 0 || beam >= std::ssize(free_m)) continue;
    const float seen_m =
        free_m[static_cast<std::size_t>(beam)] - static_cast<float>(options.margin_m);
    if (seen_m > 0.0F) free_m2_[i] = seen_m * seen_m;
  }
}

// A few points at a time, so that the compiler computes them side by side.
void FreeRangeImage::MarkSeenThrough(std::span<const ScanPoint> points,
                                     const Pose2& T_map_robot,
                                     std::span<std::uint8_t> seen_through) const {
  constexpr std::size_t kAtATime = 32;
  const Pose2 T_laser_robot = T_laser_map_ * T_map_robot;
  const Eigen::Matrix2f R = T_laser_robot.Rotation().cast<float>();
  const Eigen::Vector2f t = T_laser_robot.translation_m().cast<float>();
  std::array<float, kAtATime> x{}, y{}, distance_m2;
  std::array<std::int32_t, kAtATime> direction;
  for (std::size_t first = 0; first < points.size(); first += kAtATime) {
    const std::size_t count = std::min(kAtATime, points.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = static_cast<float>(points[first + i].p_robot_m.x());
      y[i] = static_cast<float>(points[first + i].p_robot_m.y());
    }
    for (std::size_t i = 0; i < kAtATime; ++i) {
      const float lx = R(0, 0) * x[i] + R(0, 1) * y[i] + t.x();
      const float ly = R(1, 0) * x[i] + R(1, 1) * y[i] + t.y();
      distance_m2[i] = lx * lx + ly * ly;
      direction[i] = static_cast<std::int32_t>(QuartersTo(lx, ly) * (kDirections / 4));
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (distance_m2[i] < free_m2_[static_cast<std::size_t>(direction[i]) % kDirections])
        seen_through[first + i] = 1;
    }
  }
}

void FreeSpace::Add(const LaserScan& scan, const Pose2& T_map_robot) {
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  images_.push_back({.T_robot_laser = T_robot_laser, .free = {scan, T_map_robot, options_}});
  std::ptrdiff_t of_laser = std::ranges::count(images_, T_robot_laser, &Image::T_robot_laser);
  for (; of_laser > options_.scans; images_.pop_front()) {
    if (images_.front().T_robot_laser == T_robot_laser) --of_laser;
  }
}

void FreeSpace::Move(const Pose2& T_new_old) {
  for (Image& image : images_) image.free.Move(T_new_old);
}

std::vector<ScanPoint> FreeSpace::WithoutMoving(std::span<const ScanPoint> points,
                                                const Pose2& T_map_robot) const {
  std::vector<std::uint8_t> seen_through(points.size());
  for (const Image& image : images_) image.free.MarkSeenThrough(points, T_map_robot, seen_through);
  std::vector<ScanPoint> still;
  still.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!seen_through[i]) still.push_back(points[i]);
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
