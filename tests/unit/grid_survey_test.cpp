// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/grid_survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qwsm {
namespace {

constexpr double kCell_m = 0.05;
constexpr int kSide = 120;

// A free square with unknown cells around, its centre at (0, 0) of the map.
OccupancyGrid FreeSquare() {
  OccupancyGrid grid{.cell_m = kCell_m,
                     .origin_map_m = Eigen::Vector2d::Constant(-0.5 * kCell_m * kSide),
                     .width = kSide,
                     .height = kSide,
                     .cells = std::vector(std::size_t{kSide} * kSide, CellState::kUnknown)};
  for (int y = 1; y + 1 < kSide; ++y) {
    for (int x = 1; x + 1 < kSide; ++x) grid.cells[grid.Index(x, y)] = CellState::kFree;
  }
  return grid;
}

// Draws a wall that lies at this angle and distance from the centre.
void DrawWall(double angle_rad, double distance_m, OccupancyGrid& grid) {
  const Eigen::Vector2d normal(std::cos(angle_rad), std::sin(angle_rad));
  for (int y = 1; y + 1 < kSide; ++y) {
    for (int x = 1; x + 1 < kSide; ++x) {
      const Eigen::Vector2d centre_m =
          grid.origin_map_m + kCell_m * (Eigen::Vector2d(x, y).array() + 0.5).matrix();
      const double beyond_m = normal.dot(centre_m) - distance_m;
      if (beyond_m > 0.5 * kCell_m) grid.cells[grid.Index(x, y)] = CellState::kUnknown;
      if (std::abs(beyond_m) <= 0.5 * kCell_m) {
        grid.cells[grid.Index(x, y)] = CellState::kOccupied;
      }
    }
  }
}

class SurveyedWall : public ::testing::TestWithParam<double> {};

TEST_P(SurveyedWall, LiesWhereTheCellsHaveTheirLine) {
  const double angle_rad = GetParam() * std::numbers::pi / 180.0;
  const double distance_m = 1.013;
  OccupancyGrid grid = FreeSquare();
  DrawWall(angle_rad, distance_m, grid);
  const ScanMap map = SurveyGrid(grid);
  ASSERT_FALSE(map.empty());
  const Eigen::Vector2d normal(std::cos(angle_rad), std::sin(angle_rad));
  const PointQuadtree& points = map.surfaces().quadtree();
  for (double along_m = -2.0; along_m <= 2.0; along_m += 0.1) {
    const Eigen::Vector2d p_m =
        distance_m * normal + along_m * Eigen::Vector2d(-normal.y(), normal.x());
    const auto nearest = points.Nearest(p_m, 0.1);
    ASSERT_TRUE(nearest.has_value()) << along_m;
    const Surface surface = map.surfaces().SurfaceAt(*nearest);
    EXPECT_LT(std::abs(normal.dot(surface.mean_m) - distance_m), 0.6 * kCell_m) << along_m;
    EXPECT_TRUE(surface.is_line) << along_m;
    EXPECT_GT(std::abs(normal.dot(surface.normal)), 0.97) << along_m;
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, SurveyedWall, ::testing::Values(0.0, 10.0, 30.0, 45.0, 100.0));

TEST(GridSurvey, ShowsEveryCellThatIsInView) {
  OccupancyGrid grid = FreeSquare();
  for (int i = 10; i < 110; i += 10) {
    for (int j = 10; j < 110; j += 10) grid.cells[grid.Index(i, j)] = CellState::kOccupied;
  }
  const ScanMap map = SurveyGrid(grid);
  for (int i = 10; i < 110; i += 10) {
    for (int j = 10; j < 110; j += 10) {
      const Eigen::Vector2d centre_m =
          grid.origin_map_m + kCell_m * (Eigen::Vector2d(i, j).array() + 0.5).matrix();
      EXPECT_TRUE(map.surfaces().quadtree().Nearest(centre_m, kCell_m).has_value())
          << i << ", " << j;
    }
  }
  EXPECT_LT(map.scans().size(), 50U);
}

TEST(GridSurvey, IsEmptyWhereNothingIsInView) {
  OccupancyGrid grid = FreeSquare();
  EXPECT_TRUE(SurveyGrid(grid).empty());
  std::ranges::fill(grid.cells, CellState::kOccupied);
  EXPECT_TRUE(SurveyGrid(grid).empty());
  EXPECT_TRUE(SurveyGrid({}).empty());
}

}  // namespace
}  // namespace qwsm
