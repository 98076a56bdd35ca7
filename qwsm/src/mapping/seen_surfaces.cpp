// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/seen_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace qwsm {
namespace {

// Points of one surface mostly lie no farther apart, and the frame drifts less between two looks.
constexpr double kCell_m = 0.3;

struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;

  std::uint64_t Key() const {
    return std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
  }
};

Cell CellAt(const Eigen::Vector2d& p_local_m) {
  return {static_cast<std::int32_t>(std::floor(p_local_m.x() / kCell_m)),
          static_cast<std::int32_t>(std::floor(p_local_m.y() / kCell_m))};
}

// Whether the cell or one that touches it is among those.
bool IsNearOneOf(const std::unordered_set<std::uint64_t>& cells, const Cell& cell) {
  for (const std::int32_t x : {cell.x - 1, cell.x, cell.x + 1}) {
    for (const std::int32_t y : {cell.y - 1, cell.y, cell.y + 1}) {
      if (cells.contains(Cell{x, y}.Key())) return true;
    }
  }
  return false;
}

}  // namespace

double SeenSurfaces::TakeNews(std::span<const ScanPoint> points, const Pose2& T_local_robot) {
  if (points.empty()) return 0.0;
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (const ScanPoint& point : points) cells.push_back(CellAt(T_local_robot * point.p_robot_m));
  const auto unseen =
      std::ranges::count_if(cells, [this](const Cell& cell) { return !IsNearOneOf(cells_, cell); });
  for (const Cell& cell : cells) cells_.insert(cell.Key());
  return static_cast<double>(unseen) / static_cast<double>(cells.size());
}

}  // namespace qwsm
