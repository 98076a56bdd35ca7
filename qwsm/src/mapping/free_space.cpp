// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include "qwsm/sensor/laser_mountings.hpp"

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

BeamsByDirection::BeamsByDirection(const LaserScan& scan)
    : first_bearing_rad_(scan.geometry.first_bearing_rad),
      bearing_step_rad_(scan.geometry.bearing_step_rad),
      scan_size_(scan.size()) {
  static const std::vector<double> kBearings_rad = BearingsOf(kDirections);
  for (std::size_t i = 0; i < kDirections; ++i) {
    const std::ptrdiff_t beam = NearestBeam(scan, kBearings_rad[i]);
    const bool is_there = beam >= 0 && beam < std::ssize(scan.ranges_m);
    beams_[i] = static_cast<std::uint32_t>(is_there ? beam : std::ssize(scan.ranges_m));
  }
}

bool BeamsByDirection::Fit(const LaserScan& scan) const {
  return scan.geometry.first_bearing_rad == first_bearing_rad_ &&
         scan.geometry.bearing_step_rad == bearing_step_rad_ && scan.size() == scan_size_;
}

PointColumns::PointColumns(std::span<const ScanPoint> points)
    : size_(points.size()),
      x_m_((size_ + kAtATime - 1) / kAtATime * kAtATime),
      y_m_(x_m_.size()) {
  for (std::size_t i = 0; i < size_; ++i) {
    x_m_[i] = static_cast<float>(points[i].p_robot_m.x());
    y_m_[i] = static_cast<float>(points[i].p_robot_m.y());
  }
}

FreeRangeImage::FreeRangeImage(const LaserScan& scan,
                               const Pose2& T_map_robot,
                               const FreeSpaceOptions& options,
                               std::shared_ptr<const BeamsByDirection> beams)
    : T_laser_map_((T_map_robot * scan.geometry.T_robot_laser).Inverse()),
      laser_map_(T_laser_map_),
      beams_(beams ? std::move(beams) : std::make_shared<const BeamsByDirection>(scan)) {
  std::vector<float> free_m2 = FreeAlongBeams(scan, options.margin_beams);
  for (float& of_beam : free_m2) {
    const float seen_m = std::max(0.0F, of_beam - static_cast<float>(options.margin_m));
    of_beam = seen_m * seen_m;
  }
  free_m2.push_back(0.0F);  // Where there is no beam.
  const std::span<const std::uint32_t, kDirections> beam = beams_->beams();
  for (std::size_t i = 0; i < kDirections; ++i) free_m2_[i] = free_m2[beam[i]];
}

void FreeRangeImage::Move(const Pose2& T_new_old) {
  T_laser_map_ = T_laser_map_ * T_new_old.Inverse();
  laser_map_ = RigidTransform2(T_laser_map_);
}

void FreeRangeImage::MarkSeenThrough(std::span<const ScanPoint> points,
                                     const Pose2& T_map_robot,
                                     std::span<std::uint8_t> seen_through) const {
  MarkSeenThrough(PointColumns(points), RigidTransform2(T_map_robot), seen_through);
}

// A few points at a time, so that the compiler computes them side by side.
void FreeRangeImage::MarkSeenThrough(const PointColumns& points,
                                     const RigidTransform2& T_map_robot,
                                     std::span<std::uint8_t> seen_through) const {
  constexpr std::size_t kAtATime = PointColumns::kAtATime;
  const Eigen::Matrix2f R = (laser_map_.R_a_b * T_map_robot.R_a_b).cast<float>();
  const Eigen::Vector2f t = (laser_map_ * T_map_robot.t_a_b_m).cast<float>();
  std::array<float, kAtATime> distance_m2;
  std::array<std::int32_t, kAtATime> direction;
  for (std::size_t first = 0; first < points.size(); first += kAtATime) {
    const float* x = points.x_m() + first;
    const float* y = points.y_m() + first;
    for (std::size_t i = 0; i < kAtATime; ++i) {
      const float lx = R(0, 0) * x[i] + R(0, 1) * y[i] + t.x();
      const float ly = R(1, 0) * x[i] + R(1, 1) * y[i] + t.y();
      distance_m2[i] = lx * lx + ly * ly;
      direction[i] = static_cast<std::int32_t>(QuartersTo(lx, ly) * (kDirections / 4)) &
                     static_cast<std::int32_t>(kDirections - 1);
    }
    const std::size_t count = std::min(kAtATime, points.size() - first);
    std::uint8_t* marks = &seen_through[first];
    for (std::size_t i = 0; i < count; ++i) {
      const float free_m2 = free_m2_[static_cast<std::size_t>(direction[i])];
      marks[i] |= static_cast<std::uint8_t>(distance_m2[i] < free_m2);
    }
  }
}

void FreeSpace::Add(const LaserScan& scan, const Pose2& T_map_robot) {
  const Pose2& T_robot_laser = scan.geometry.T_robot_laser;
  images_.push_back({.T_robot_laser = T_robot_laser, .free = {scan, T_map_robot, options_, BeamsOf(scan)}});
  std::ptrdiff_t of_laser = std::ranges::count(images_, T_robot_laser, &Image::T_robot_laser);
  const std::size_t most = kMostMountings * static_cast<std::size_t>(options_.scans);
  for (; of_laser > options_.scans || images_.size() > most; images_.pop_front()) {
    if (images_.front().T_robot_laser == T_robot_laser) --of_laser;
  }
}

void FreeSpace::Move(const Pose2& T_new_old) {
  for (Image& image : images_) image.free.Move(T_new_old);
}

// A laser's beams mostly point where those of the scan before did.
std::shared_ptr<const BeamsByDirection> FreeSpace::BeamsOf(const LaserScan& scan) const {
  for (auto image = images_.rbegin(); image != images_.rend(); ++image) {
    if (image->free.beams()->Fit(scan)) return image->free.beams();
  }
  return nullptr;
}

std::vector<std::uint8_t> FreeSpace::MovingAmong(std::span<const ScanPoint> points,
                                                 const Pose2& T_map_robot) const {
  std::vector<std::uint8_t> marks(points.size());
  const PointColumns columns(points);
  const RigidTransform2 map_robot(T_map_robot);
  for (const Image& image : images_) image.free.MarkSeenThrough(columns, map_robot, marks);
  const auto moving = static_cast<double>(std::ranges::count(marks, 1));
  const double most = options_.max_moving_share * static_cast<double>(points.size());
  if (moving == 0.0 || moving > most) marks.clear();
  return marks;
}

std::vector<ScanPoint> FreeSpace::WithoutMoving(std::span<const ScanPoint> points,
                                                const Pose2& T_map_robot) const {
  const std::vector<std::uint8_t> moving = MovingAmong(points, T_map_robot);
  if (moving.empty()) return {points.begin(), points.end()};
  std::vector<ScanPoint> still;
  still.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (moving[i] == 0) still.push_back(points[i]);
  }
  return still;
}

LaserScan WithoutMarked(LaserScan scan,
                        std::span<const ScanPoint> points,
                        std::span<const std::uint8_t> marks) {
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) scan.ranges_m[points[i].beam] = std::numeric_limits<float>::quiet_NaN();
  }
  return scan;
}

}  // namespace qwsm
