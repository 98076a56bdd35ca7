// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/local_submap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "qwsm/sensor/laser_mountings.hpp"

namespace qwsm {
namespace {

// Row and column in one number.
std::uint64_t CellOf(const Eigen::Vector2d& p_m, double side_m) {
  const auto index = [side_m](double coordinate_m) {
    return static_cast<std::uint32_t>(std::lround(coordinate_m / side_m));
  };
  return std::uint64_t{index(p_m.y())} << 32 | index(p_m.x());
}

}  // namespace

void LocalSubmap::Add(const Pose2& T_map_robot,
                      std::span<const ScanPoint> points,
                      const Pose2& T_robot_laser) {
  if (points.empty()) return;
  scans_.push_back({.T_map_robot = T_map_robot,
                    .T_robot_laser = T_robot_laser,
                    .points = ThinOut(points, options_.spacing_m)});
  points_ += scans_.back().points.size();
  std::ptrdiff_t of_laser = std::ranges::count(scans_, T_robot_laser, &Scan::T_robot_laser);
  const std::size_t most = kMostMountings * static_cast<std::size_t>(options_.count);
  const auto enough_points = static_cast<std::size_t>(options_.points);
  while ((of_laser > options_.count || scans_.size() > most) &&
         points_ - scans_.front().points.size() >= enough_points) {
    if (scans_.front().T_robot_laser == T_robot_laser) --of_laser;
    points_ -= scans_.front().points.size();
    scans_.pop_front();
  }
}

void LocalSubmap::Clear() {
  scans_.clear();
  points_ = 0;
}

void LocalSubmap::Move(const Pose2& T_new_old) {
  for (Scan& scan : scans_) scan.T_map_robot = T_new_old * scan.T_map_robot;
}

std::vector<ScanPoint> LocalSubmap::PointsAround(const Pose2& T_map_robot) const {
  struct Seen {
    std::uint64_t cell;
    std::size_t number;  // The latest scan's points come first.
    const RigidTransform2* T_robot_then;
    const ScanPoint* point;
  };
  std::vector<RigidTransform2> T_robot_then;
  T_robot_then.reserve(scans_.size());
  std::vector<Seen> seen;
  seen.reserve(points_);
  for (auto scan = scans_.rbegin(); scan != scans_.rend(); ++scan) {
    T_robot_then.emplace_back(T_map_robot.Inverse() * scan->T_map_robot);
    for (const ScanPoint& point : scan->points) {
      const Eigen::Vector2d now = T_robot_then.back() * point.p_robot_m;
      seen.push_back({.cell = CellOf(now, options_.spacing_m),
                      .number = seen.size(),
                      .T_robot_then = &T_robot_then.back(),
                      .point = &point});
    }
  }
  std::ranges::sort(seen, {}, [](const Seen& s) { return std::pair(s.cell, s.number); });
  const auto is_same_cell = [](const Seen& a, const Seen& b) { return a.cell == b.cell; };
  seen.erase(std::unique(seen.begin(), seen.end(), is_same_cell), seen.end());
  std::vector<ScanPoint> points;
  points.reserve(seen.size());
  for (const Seen& one : seen) points.push_back(*one.T_robot_then * *one.point);
  return points;
}

}  // namespace qwsm
