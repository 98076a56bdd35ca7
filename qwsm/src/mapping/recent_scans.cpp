// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/recent_scans.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace qwsm {

void RecentScans::Add(const Pose2& T_map_robot, std::span<const ScanPoint> points) {
  if (points.empty()) return;
  scans_.push_back({.T_map_robot = T_map_robot, .points = ThinOut(points, options_.spacing_m)});
  points_ += scans_.back().points.size();
  const auto enough_scans = static_cast<std::size_t>(options_.count);
  const auto enough_points = static_cast<std::size_t>(options_.points);
  while (scans_.size() > enough_scans && points_ - scans_.front().points.size() >= enough_points) {
    points_ -= scans_.front().points.size();
    scans_.pop_front();
  }
}

void RecentScans::Clear() {
  scans_.clear();
  points_ = 0;
}

std::vector<ScanPoint> RecentScans::PointsAround(const Pose2& T_map_robot) const {
  using CellAndPoint = std::pair<std::pair<std::int64_t, std::int64_t>, ScanPoint>;
  std::vector<CellAndPoint> cells;
  for (auto scan = scans_.rbegin(); scan != scans_.rend(); ++scan) {
    const Pose2 T_robot_then = T_map_robot.Inverse() * scan->T_map_robot;
    for (const ScanPoint& point : scan->points) {
      const ScanPoint now = T_robot_then * point;
      cells.push_back({{std::llround(now.p_robot_m.x() / options_.spacing_m),
                        std::llround(now.p_robot_m.y() / options_.spacing_m)},
                       now});
    }
  }
  // Stable: of the points in one cell the latest stays.
  const auto by_cell = [](const CellAndPoint& a, const CellAndPoint& b) {
    return a.first < b.first;
  };
  std::ranges::stable_sort(cells, by_cell);
  std::vector<ScanPoint> points;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i == 0 || cells[i].first != cells[i - 1].first) points.push_back(cells[i].second);
  }
  return points;
}

}  // namespace qwsm
