// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/world_picture.hpp"

#include <algorithm>
#include <cmath>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/io/pictures/trajectory_picture.hpp"

namespace qwsm::pipeline {
namespace {

constexpr double kFinestCell_m = 0.05;
constexpr double kMaxCells = 16e6;
constexpr double kMargin_m = 1.0;

/// A box with the axes of `T_world_box`; where `radius_m` is set, a disc instead.
struct Solid {
  Pose2 T_world_box;
  Eigen::Vector2d half_size_m;
  double radius_m = 0.0;

  /// Half the size of the upright box round it.
  Eigen::Vector2d Reach_m() const {
    return (T_world_box.Rotation().cwiseAbs() * half_size_m).array() + radius_m;
  }
  /// Whether a point is inside, or nearer to it than `slack_m`: thin things stay visible.
  bool Contains(const Eigen::Vector2d& p_world_m, double slack_m) const {
    const Eigen::Vector2d p_box_m = T_world_box.Inverse() * p_world_m;
    if (radius_m > 0.0) return p_box_m.norm() <= radius_m + slack_m;
    return (p_box_m.cwiseAbs() - half_size_m).maxCoeff() <= slack_m;
  }
};

std::vector<Solid> SolidsOf(const sim::SceneryOptions& scenery) {
  std::vector<Solid> solids;
  for (const sim::WallOptions& wall : scenery.walls) {
    const Eigen::Vector2d from_m(wall.from_x_m, wall.from_y_m);
    const Eigen::Vector2d way_m = Eigen::Vector2d(wall.to_x_m, wall.to_y_m) - from_m;
    const Eigen::Vector2d middle_m = from_m + 0.5 * way_m;
    const double half_m = 0.5 * wall.thickness_m;
    // Walls end half their thickness beyond their corners, so that corners are closed.
    solids.push_back({{middle_m.x(), middle_m.y(), std::atan2(way_m.y(), way_m.x())},
                      {0.5 * way_m.norm() + half_m, half_m}});
  }
  for (const sim::BoxOptions& box : scenery.boxes) {
    solids.push_back(
        {{box.x_m, box.y_m, box.heading_rad}, {0.5 * box.length_m, 0.5 * box.width_m}});
  }
  for (const sim::RoundOptions& thing : scenery.rounds) {
    solids.push_back({{thing.x_m, thing.y_m, 0.0}, Eigen::Vector2d::Zero(), thing.radius_m});
  }
  return solids;
}

/// Free cells round all that is to be seen.
OccupancyGrid EmptyGrid(const std::vector<Solid>& solids, const WorldPaths& paths) {
  Eigen::Vector2d low_m = paths.truth.front().T_map_robot.translation_m();
  Eigen::Vector2d high_m = low_m;
  const auto include = [&](const Eigen::Vector2d& p_m, const Eigen::Vector2d& reach_m) {
    low_m = low_m.cwiseMin(p_m - reach_m);
    high_m = high_m.cwiseMax(p_m + reach_m);
  };
  const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(kMargin_m);
  for (const StampedPose2& pose : paths.truth) include(pose.T_map_robot.translation_m(), margin_m);
  for (const Solid& solid : solids) include(solid.T_world_box.translation_m(), solid.Reach_m());
  low_m -= 0.5 * margin_m;
  high_m += 0.5 * margin_m;
  const Eigen::Vector2d extent_m = high_m - low_m;
  OccupancyGrid grid;
  grid.cell_m = std::max(kFinestCell_m, std::sqrt(extent_m.prod() / kMaxCells));
  grid.origin_map_m = low_m;
  grid.width = static_cast<int>(std::ceil(extent_m.x() / grid.cell_m)) + 1;
  grid.height = static_cast<int>(std::ceil(extent_m.y() / grid.cell_m)) + 1;
  grid.cells.assign(grid.Index(0, grid.height), CellState::kFree);
  return grid;
}

void Draw(const Solid& solid, OccupancyGrid& grid) {
  const Eigen::Vector2d middle_m = solid.T_world_box.translation_m() - grid.origin_map_m;
  const Eigen::Vector2d reach_m = solid.Reach_m().array() + grid.cell_m;
  const auto cell = [&](double at_m, int count) {
    return std::clamp(static_cast<int>(std::floor(at_m / grid.cell_m)), 0, count - 1);
  };
  for (int y = cell(middle_m.y() - reach_m.y(), grid.height);
       y <= cell(middle_m.y() + reach_m.y(), grid.height);
       ++y) {
    for (int x = cell(middle_m.x() - reach_m.x(), grid.width);
         x <= cell(middle_m.x() + reach_m.x(), grid.width);
         ++x) {
      const Eigen::Vector2d p_m =
          grid.origin_map_m + grid.cell_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      if (solid.Contains(p_m, 0.5 * grid.cell_m)) {
        grid.cells[grid.Index(x, y)] = CellState::kOccupied;
      }
    }
  }
}

}  // namespace

void WriteWorldPicture(const std::filesystem::path& path,
                       const sim::SceneryOptions& scenery,
                       const WorldPaths& paths) {
  if (paths.truth.empty()) return;
  const std::vector<Solid> solids = SolidsOf(scenery);
  OccupancyGrid grid = EmptyGrid(solids, paths);
  for (const Solid& solid : solids) Draw(solid, grid);
  io::WriteTrajectoryPicture(
      path, grid, {.path = {}, .truth = paths.truth, .odometry = paths.odometry});
}

}  // namespace qwsm::pipeline
