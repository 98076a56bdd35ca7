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
  scans_.push_back(
      {.T_map_robot = T_map_robot, .points_robot_m = ThinOut(points, options_.spacing_m)});
  points_ += scans_.back().points_robot_m.size();
  const auto enough_scans = static_cast<std::size_t>(options_.count);
  const auto enough_points = static_cast<std::size_t>(options_.points);
  while (scans_.size() > enough_scans &&
         points_ - scans_.front().points_robot_m.size() >= enough_points) {
    points_ -= scans_.front().points_robot_m.size();
    scans_.pop_front();
  }
}

void RecentScans::Clear() {
  scans_.clear();
  points_ = 0;
}

std::vector<Eigen::Vector2d> RecentScans::PointsAround(const Pose2& T_map_robot) const {
  using CellAndPoint = std::pair<std::pair<std::int64_t, std::int64_t>, Eigen::Vector2d>;
  std::vector<CellAndPoint> cells;
  for (auto scan = scans_.rbegin(); scan != scans_.rend(); ++scan) {
    const Pose2 T_robot_then = T_map_robot.Inverse() * scan->T_map_robot;
    for (const Eigen::Vector2d& p_then : scan->points_robot_m) {
      const Eigen::Vector2d p_robot = T_robot_then * p_then;
      cells.push_back({{std::llround(p_robot.x() / options_.spacing_m),
                        std::llround(p_robot.y() / options_.spacing_m)},
                       p_robot});
    }
  }
  // Stable: of the points in one cell the latest stays.
  const auto by_cell = [](const CellAndPoint& a, const CellAndPoint& b) {
    return a.first < b.first;
  };
  std::ranges::stable_sort(cells, by_cell);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i == 0 || cells[i].first != cells[i - 1].first) points.push_back(cells[i].second);
  }
  return points;
}

}  // namespace qwsm
