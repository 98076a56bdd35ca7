// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "qwsm/mapping/occupancy_painter.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm {
namespace {

using std::numbers::pi;

// Beams ahead (+x), to the left (+y), back and to the right, from the middle of the cell at the
// origin when cells are 1 m.
RelevantScan FourBeams(const std::vector<float>& ranges_m) {
  const LaserGeometry geometry{.first_bearing_rad = 0.0F,
                               .bearing_step_rad = static_cast<float>(pi / 2),
                               .range_min_m = 0.1F,
                               .range_max_m = 20.0F,
                               .T_robot_laser = {}};
  return {.id = 0,
          .scan = {.stamp = {}, .geometry = geometry, .ranges_m = ranges_m},
          .map_robot = {.T_a_b = {0.5, 0.5, 0.0}}};
}

OccupancyGridOptions OneMetreCells() { return {.cell_m = 1.0}; }

CellState StateAt(const OccupancyGrid& grid, double x_m, double y_m) {
  const int x = static_cast<int>(std::floor((x_m - grid.origin_map_m.x()) / grid.cell_m));
  const int y = static_cast<int>(std::floor((y_m - grid.origin_map_m.y()) / grid.cell_m));
  return grid.At(x, y);
}

// The cells from (0, 0) along +x as text: # occupied, . free, ? unknown.
std::string RowAhead(const OccupancyGrid& grid, int count) {
  std::string row;
  for (int x = 0; x < count; ++x) {
    const CellState state = StateAt(grid, x + 0.5, 0.5);
    row += state == CellState::kOccupied ? '#' : state == CellState::kFree ? '.' : '?';
  }
  return row;
}

std::string RowAhead(const std::vector<RelevantScan>& scans, const OccupancyGridOptions& options) {
  const OccupancyGridResult result = RenderOccupancyGrid(scans, options);
  EXPECT_EQ(result.status, RenderStatus::kRendered);
  return RowAhead(result.grid, 7);
}

TEST(OccupancyGrid, IsFreeUpToAHitAndUnknownBehind) {
  EXPECT_EQ(RowAhead({FourBeams({4.0F, 2.0F, 2.0F, 2.0F})}, OneMetreCells()), "....#??");
}

TEST(OccupancyGrid, TakesTheWayOfAMissAsFreeUpToALimit) {
  OccupancyGridOptions options = OneMetreCells();
  options.miss_free_range_m = 3.0;
  EXPECT_EQ(RowAhead({FourBeams({20.0F, 20.0F, 2.0F, 2.0F})}, options), "...????");
}

TEST(OccupancyGrid, TakesALoneMissAsALostEcho) {
  EXPECT_EQ(RowAhead({FourBeams({20.0F, 2.0F, 2.0F, 2.0F})}, OneMetreCells()), ".??????");
}

TEST(OccupancyGrid, BelievesNoSurfaceBeyondTheUsableRange) {
  OccupancyGridOptions options = OneMetreCells();
  options.usable_range_m = 3.0;
  EXPECT_EQ(RowAhead({FourBeams({5.0F, 2.0F, 2.0F, 2.0F})}, options), "...????");
}

TEST(OccupancyGrid, IgnoresReadingsThatAreTooNearOrNoNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(RowAhead({FourBeams({0.05F, nan, 2.0F, -1.0F})}, OneMetreCells()), ".??????");
  const std::vector<RelevantScan> scans = {FourBeams({0.05F, nan, 0.0F, -1.0F})};
  EXPECT_EQ(RenderOccupancyGrid(scans).status, RenderStatus::kNothingMeasured);
  EXPECT_EQ(RenderOccupancyGrid({}).status, RenderStatus::kNothingMeasured);
}

TEST(OccupancyGrid, LetsTheShareOfHitsDecide) {
  OccupancyGridOptions options = OneMetreCells();
  const RelevantScan hit = FourBeams({3.0F, 2.0F, 2.0F, 2.0F});
  const RelevantScan passed = FourBeams({5.0F, 2.0F, 2.0F, 2.0F});
  options.occupied_share = 0.5;
  EXPECT_EQ(RowAhead({hit, passed}, options), "...#.#?");
  options.occupied_share = 0.51;
  // Both hit or passed cells 3 and 5: half of the scans that saw cell 3, all that saw cell 5.
  EXPECT_EQ(RowAhead({hit, passed}, options), ".....#?");
}

TEST(OccupancyGrid, StandsWhereTheLaserLooks) {
  RelevantScan scan = FourBeams({3.0F, 4.0F, 2.0F, 2.0F});
  scan.map_robot.T_a_b = {-20.5, 7.5, pi / 2};
  scan.scan.geometry.T_robot_laser = {1.0, 0.0, 0.0};  // At (-20.5, 8.5).
  const std::vector<RelevantScan> scans = {scan};
  const OccupancyGridResult result = RenderOccupancyGrid(scans, OneMetreCells());
  ASSERT_EQ(result.status, RenderStatus::kRendered);
  EXPECT_EQ(StateAt(result.grid, -20.5, 11.5), CellState::kOccupied);
  EXPECT_EQ(StateAt(result.grid, -24.5, 8.5), CellState::kOccupied);
  EXPECT_EQ(StateAt(result.grid, -20.5, 9.5), CellState::kFree);
  EXPECT_EQ(StateAt(result.grid, -20.5, 12.5), CellState::kUnknown);
  EXPECT_EQ(std::ranges::count(result.grid.cells, CellState::kOccupied), 4);
}

TEST(OccupancyGrid, RefusesWhatDoesNotFitAndSaysWhatWould) {
  RelevantScan far_away = FourBeams({3.0F, 4.0F, 2.0F, 2.0F});
  far_away.map_robot.T_a_b = {1e6, 1e6, 0.0};
  std::vector<RelevantScan> scans = {FourBeams({3.0F, 4.0F, 2.0F, 2.0F}), far_away};
  OccupancyGridOptions options{.cell_m = 0.05, .max_megacells = 10};
  const OccupancyGridResult refused = RenderOccupancyGrid(scans, options);
  EXPECT_EQ(refused.status, RenderStatus::kTooLarge);
  EXPECT_TRUE(refused.grid.cells.empty());
  EXPECT_NEAR(refused.extent_x_m, 1e6, 10.0);
  EXPECT_DOUBLE_EQ(refused.smallest_cell_m, 500.0);
  options.cell_m = refused.smallest_cell_m;
  EXPECT_EQ(RenderOccupancyGrid(scans, options).status, RenderStatus::kRendered);

  for (const double x_m : {1e30, 1e300, 1.7e308}) {
    scans[1].map_robot.T_a_b.x_m = x_m;
    EXPECT_EQ(RenderOccupancyGrid(scans, options).status, RenderStatus::kTooLarge) << x_m;
  }
  scans[0] = scans[1];  // Small, but where cells cannot be told apart.
  EXPECT_EQ(RenderOccupancyGrid(scans, options).status, RenderStatus::kTooLarge);
}

TEST(OccupancyGrid, LeavesOutScansWithoutAPose) {
  RelevantScan lost = FourBeams({9.0F, 9.0F, 9.0F, 9.0F});
  lost.map_robot.T_a_b.x_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RowAhead({lost, FourBeams({4.0F, 2.0F, 2.0F, 2.0F})}, OneMetreCells()), "....#??");
}

// The scans of a drive through the two rooms, at their true poses.
std::vector<RelevantScan> RelevantScansOf(const test::SimulatedDrive& drive) {
  std::vector<RelevantScan> scans;
  for (std::size_t i = 0; i < drive.observations.size(); i += 3) {
    scans.push_back({.id = static_cast<ScanId>(scans.size()),
                     .scan = drive.observations[i].scan,
                     .map_robot = {.T_a_b = drive.T_world_robot[i]}});
  }
  return scans;
}

TEST(OccupancyGrid, DoesNotDependOnTheOrderOfTheScans) {
  std::vector<RelevantScan> scans = RelevantScansOf(DriveThrough(test::TwoRoomsAndCorridor(), {}));
  const OccupancyGridResult forwards = RenderOccupancyGrid(scans);
  std::ranges::reverse(scans);
  const OccupancyGridResult backwards = RenderOccupancyGrid(scans);
  ASSERT_EQ(forwards.status, RenderStatus::kRendered);
  EXPECT_EQ(forwards.grid.cells, backwards.grid.cells);
}

TEST(OccupancyGrid, IsTheSamePaintedScanByScanAsAllAtOnce) {
  const std::vector<RelevantScan> scans =
      RelevantScansOf(DriveThrough(test::TwoRoomsAndCorridor(), {}));
  OccupancyPainter painter;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    painter.Add(scans[i]);
    if (i % 40 != 0 && i + 1 != scans.size()) continue;
    SCOPED_TRACE(i);
    const OccupancyGridResult painted = painter.Grid();
    const OccupancyGridResult rendered = RenderOccupancyGrid(std::span(scans).first(i + 1));
    EXPECT_EQ(painted.status, rendered.status);
    EXPECT_EQ(painted.grid.origin_map_m, rendered.grid.origin_map_m);
    ASSERT_EQ(painted.grid.width, rendered.grid.width);
    ASSERT_EQ(painted.grid.cells, rendered.grid.cells);
  }
}

double DistanceToSurface(const test::World& world, const Eigen::Vector2d& p_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const test::Wall& wall : world.walls) {
    const Eigen::Vector2d along_m = wall.to_m - wall.from_m;
    const double share =
        std::clamp((p_m - wall.from_m).dot(along_m) / along_m.squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (wall.from_m + share * along_m - p_m).norm());
  }
  for (const test::Column& column : world.columns) {
    nearest_m = std::min(nearest_m, std::abs((column.center_m - p_m).norm() - column.radius_m));
  }
  return nearest_m;
}

// Every occupied cell is near a wall, and nearly all of the way that was driven is free.
TEST(OccupancyGrid, HoldsMemoryForWhatWasSeenHoweverFarApart) {
  RelevantScan scan = FourBeams({5.0F, 5.0F, 5.0F, 5.0F});
  OccupancyPainter near;
  near.Add(scan);
  OccupancyPainter far;
  far.Add(scan);
  scan.map_robot.T_a_b = {200.0, -150.0, 1.0};
  far.Add(scan);
  EXPECT_EQ(far.Grid().status, RenderStatus::kRendered);
  EXPECT_LE(far.bytes(), 3 * near.bytes());  // A tile more or less, where it begins.
  EXPECT_LT(near.bytes(), 500'000U);
}

TEST(OccupancyGrid, OfASimulatedDriveIsTheWorld) {
  const test::Scene scene = test::TwoRoomsAndCorridor();
  const test::SimulatedDrive drive = DriveThrough(scene, {});
  const OccupancyGridResult result = RenderOccupancyGrid(RelevantScansOf(drive));
  ASSERT_EQ(result.status, RenderStatus::kRendered);
  const OccupancyGrid& grid = result.grid;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (grid.At(x, y) != CellState::kOccupied) continue;
      const Eigen::Vector2d center_m =
          grid.origin_map_m + grid.cell_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      ASSERT_LT(DistanceToSurface(scene.world, center_m), 0.12) << center_m.transpose();
    }
  }
  for (const Pose2& T_world_robot : drive.T_world_robot) {
    EXPECT_EQ(StateAt(grid, T_world_robot.x_m, T_world_robot.y_m), CellState::kFree);
  }
}

}  // namespace
}  // namespace qwsm
