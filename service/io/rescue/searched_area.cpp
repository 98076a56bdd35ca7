// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/rescue/searched_area.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace qwsm::io {
namespace {

constexpr double kBetweenPlaces_m = 0.25;

/// Looks around at one place after the other.
class Searcher {
 public:
  Searcher(const OccupancyGrid& grid, double radius_m)
      : grid_(grid),
        radius_m_(radius_m),
        looks_(grid.cells.size()),
        last_place_(grid.cells.size()) {}

  void LookAround(const Eigen::Vector2d& p_map_m) {
    ++place_;
    // Rays are no farther apart than half a cell.
    const double step_rad = 0.5 * grid_.cell_m / std::max(radius_m_, grid_.cell_m);
    const int rays = static_cast<int>(std::ceil(2.0 * std::numbers::pi / step_rad));
    for (int ray = 0; ray < rays; ++ray) {
      const double bearing_rad = 2.0 * std::numbers::pi * ray / rays;
      Look(p_map_m, {std::cos(bearing_rad), std::sin(bearing_rad)});
    }
  }

  std::vector<std::uint8_t> TakeLooks() { return std::move(looks_); }

 private:
  void Look(const Eigen::Vector2d& from_map_m, const Eigen::Vector2d& direction) {
    for (double range_m = 0.0; range_m <= radius_m_; range_m += 0.5 * grid_.cell_m) {
      const Eigen::Vector2d p_cells =
          (from_map_m + range_m * direction - grid_.origin_map_m) / grid_.cell_m;
      const bool is_inside =
          p_cells.minCoeff() >= 0.0 && p_cells.x() < grid_.width && p_cells.y() < grid_.height;
      if (!is_inside) return;
      const std::size_t cell =
          grid_.Index(static_cast<int>(p_cells.x()), static_cast<int>(p_cells.y()));
      if (grid_.cells[cell] != CellState::kFree) return;
      if (last_place_[cell] == place_) continue;
      last_place_[cell] = place_;
      if (looks_[cell] < kMostLooks) ++looks_[cell];
    }
  }

  const OccupancyGrid& grid_;
  double radius_m_;
  std::vector<std::uint8_t> looks_;
  std::vector<std::uint32_t> last_place_;  // From which each cell was seen last.
  std::uint32_t place_ = 0;
};

}  // namespace

std::vector<std::uint8_t> LooksAtCells(const OccupancyGrid& grid,
                                       std::span<const std::vector<Pose2>> paths,
                                       double radius_m) {
  Searcher searcher(grid, radius_m);
  for (const std::vector<Pose2>& path : paths) {
    std::optional<Eigen::Vector2d> last;
    for (const Pose2& pose : path) {
      const Eigen::Vector2d here = pose.translation_m();
      if (last && (here - *last).norm() < kBetweenPlaces_m) continue;
      searcher.LookAround(here);
      last = here;
    }
  }
  return searcher.TakeLooks();
}

}  // namespace qwsm::io
