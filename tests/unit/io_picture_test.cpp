// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What pictures show is for people to judge; here is what a program can.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "service/io/files/atomic_file.hpp"
#include "service/io/pictures/axis.hpp"
#include "service/io/pictures/canvas.hpp"
#include "service/io/pictures/covariance_ellipse.hpp"
#include "service/io/pictures/legend.hpp"
#include "service/io/pictures/map_image.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/io/pictures/residual_plot.hpp"
#include "service/io/pictures/team_picture.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::io {
namespace {

namespace fs = std::filesystem;
using test::ReadFile;
using test::TemporaryFolder;

TEST(Axis, TicksAreNiceAndFewEnough) {
  EXPECT_DOUBLE_EQ(RoundUpToNice(0.13), 0.2);
  EXPECT_DOUBLE_EQ(RoundUpToNice(0.2), 0.2);
  EXPECT_DOUBLE_EQ(RoundUpToNice(1000.0), 1000.0);
  EXPECT_DOUBLE_EQ(RoundUpToNice(5.1), 10.0);
  const std::vector<double> ticks = Ticks(-0.3, 1.0, 7);
  ASSERT_EQ(ticks.size(), 7U);
  EXPECT_NEAR(ticks.front(), -0.2, 1e-12);
  EXPECT_NEAR(ticks.back(), 1.0, 1e-12);
}

TEST(Axis, LabelsHaveNoMoreDigitsThanNeeded) {
  EXPECT_EQ(TickLabel(0.4, 0.2), "0.4");
  EXPECT_EQ(TickLabel(-3.0, 1.0), "\u22123");
  EXPECT_EQ(TickLabel(-1e-17, 0.2), "0");
  EXPECT_EQ(TickLabel(13600.0, 200.0), "13\u2009600");
  EXPECT_EQ(TickLabel(1360.0, 20.0), "1360");
  EXPECT_EQ(LengthLabel(0.5), "50 cm");
  EXPECT_EQ(LengthLabel(20.0), "20 m");
  EXPECT_EQ(LengthLabel(1500.0), "1.5 km");
}

TEST(CovarianceEllipse, HasTheAxesOfTheCovariance) {
  Eigen::Matrix3d covariance = Eigen::Vector3d(0.04, 0.01, 1.0).asDiagonal();
  const Eigen::Matrix2d half_axes_m = HalfAxes95(covariance);
  EXPECT_NEAR(half_axes_m.colwise().norm().maxCoeff(), 2.4477 * 0.2, 1e-4);
  EXPECT_NEAR(half_axes_m.colwise().norm().minCoeff(), 2.4477 * 0.1, 1e-4);
  for (const Eigen::Vector2d& point_m : EllipseOutline({1.0, 2.0}, half_axes_m)) {
    const Eigen::Vector2d error_m = point_m - Eigen::Vector2d(1.0, 2.0);
    EXPECT_NEAR(error_m.x() * error_m.x() / 0.04 + error_m.y() * error_m.y() / 0.01, 5.9915, 1e-3);
  }
  covariance(0, 0) = std::nan("");
  EXPECT_TRUE(HalfAxes95(covariance).isZero());
}

TEST(CovarianceEllipse, IsEnlargedOnlyWhereItWouldNotBeSeen) {
  EXPECT_EQ(Enlargement({}), 1.0);
  EXPECT_EQ(Enlargement({30.0, 9.0, 8.5}), 1.0);
  EXPECT_EQ(Enlargement({0.9, 1.0, 30.0}), 10.0);
  EXPECT_EQ(Enlargement({0.0, 0.0}), 1000.0);
}

// 40 x 20 cells: walls around free space in the left half.
OccupancyGrid HalfKnownGrid(double cell_m) {
  OccupancyGrid grid{
      .cell_m = cell_m, .origin_map_m = {-1.0, 0.0}, .width = 40, .height = 20, .cells = {}};
  grid.cells.assign(800, CellState::kUnknown);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool is_wall = x == 0 || y == 0 || x == 19 || y == 19;
      grid.cells[grid.Index(x, y)] = is_wall ? CellState::kOccupied : CellState::kFree;
    }
  }
  return grid;
}

constexpr std::uint32_t kWallPixel = 0x002878;

std::uint32_t PixelAt(const PixelImage& image, const Eigen::Vector2d& at_px) {
  const auto row = static_cast<std::size_t>(at_px.y());
  return image
      .pixels[row * static_cast<std::size_t>(image.width_px) + static_cast<std::size_t>(at_px.x())];
}

TEST(MapImage, ShowsEveryCellWhereItIs) {
  const OccupancyGrid grid = HalfKnownGrid(0.05);
  const MapView view(grid, grid.origin_map_m, grid.origin_map_m);
  const PixelImage image = RenderMap(grid, view);
  EXPECT_EQ(image.width_px, 800);  // 20 pixels per cell, and no more.
  EXPECT_EQ(image.height_px, 400);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Eigen::Vector2d center_m =
          grid.origin_map_m + grid.cell_m * Eigen::Vector2d(x + 0.5, y + 0.5);
      const Eigen::Vector2d at_px = view.ToPixel(center_m);
      EXPECT_TRUE(view.ToMap(at_px).isApprox(center_m));
      const bool is_wall = PixelAt(image, at_px) == kWallPixel;
      EXPECT_EQ(is_wall, grid.At(x, y) == CellState::kOccupied) << x << ' ' << y;
    }
  }
}

TEST(MapImage, LosesNoWallOfALargeMap) {
  OccupancyGrid grid{
      .cell_m = 0.1, .origin_map_m = {0, 0}, .width = 9000, .height = 300, .cells = {}};
  grid.cells.assign(2'700'000, CellState::kFree);
  for (int y = 0; y < grid.height; ++y) grid.cells[grid.Index(4321, y)] = CellState::kOccupied;
  const MapView view(grid, grid.origin_map_m, grid.origin_map_m);
  const PixelImage image = RenderMap(grid, view);
  EXPECT_LE(image.width_px, 2000);
  EXPECT_GE(image.width_px, 900);
  EXPECT_EQ(std::ranges::count(image.pixels, kWallPixel), image.height_px);
}

TEST(MapImage, MakesRoomForWhatIsOutsideOfTheMap) {
  const OccupancyGrid grid = HalfKnownGrid(0.05);
  const MapView view(grid, {-2.0, -0.51}, {0.0, 3.0});
  const Eigen::Vector2d low_px = view.ToPixel({-2.0, -0.51});
  EXPECT_GE(low_px.x(), 0.0);
  EXPECT_LE(low_px.y(), view.height_px());
  EXPECT_GE(view.ToPixel({0.0, 3.0}).y(), 0.0);
  const PixelImage image = RenderMap(grid, view);
  EXPECT_EQ(PixelAt(image, view.ToPixel({-0.975, 0.5})), kWallPixel);
}

TEST(Legend, BreaksLinesWhereTheyAreFull) {
  const LegendItem item = LineItem("some words", {});
  const Legend wide({item, item, item}, 1000.0);
  const Legend narrow({item, item, item}, 150.0);
  EXPECT_DOUBLE_EQ(narrow.height_px(), 3.0 * wide.height_px());
}

// Width and height as a PNG's header has them.
std::pair<int, int> SizeOfPng(const std::string& png) {
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = value * 256 + static_cast<unsigned char>(png[i]);
    return value;
  };
  return {number(16), number(20)};
}

TEST(Canvas, SavesTheFormatThatTheNameSays) {
  const TemporaryFolder folder;
  Canvas canvas(120, 80);
  canvas.Write("words", {10.0, 40.0}, {});
  canvas.Save(folder.path() / "picture.png");
  canvas.Save(folder.path() / "picture.svg");
  const std::string png = ReadFile(folder.path() / "picture.png");
  EXPECT_TRUE(png.starts_with("\x89PNG"));
  EXPECT_EQ(SizeOfPng(png), std::pair(120, 80));
  const std::string svg = ReadFile(folder.path() / "picture.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_THROW(canvas.Save(folder.path() / "picture.gif"), std::invalid_argument);
  EXPECT_THROW(canvas.Save(folder.path() / "no folder" / "picture.png"), WriteError);
}

MapOverlay OverlayOf(int poses) {
  MapOverlay overlay;
  for (int i = 0; i < poses; ++i) {
    const Pose2 T_map_robot{-0.5 + 0.01 * i, 0.5, 0.0};
    overlay.path.push_back(
        {.stamp = std::chrono::seconds(i),
         .map_robot = {.T_a_b = T_map_robot, .covariance = 1e-4 * Eigen::Matrix3d::Identity()},
         .status = i % 7 == 0 ? StepStatus::kDeadReckoned : StepStatus::kMatched});
    overlay.truth.push_back({std::chrono::seconds(i), T_map_robot});
    overlay.odometry.push_back({std::chrono::seconds(i), {5.0 * i, 0.0, 0.0}});
  }
  return overlay;
}

TEST(Pictures, AreDrawnOfMuchAndOfNothing) {
  const TemporaryFolder folder;
  const OccupancyGrid grid = HalfKnownGrid(0.05);
  WriteMapPicture(folder.path() / "map.png", grid);
  const std::string map = ReadFile(folder.path() / "map.png");
  EXPECT_EQ(SizeOfPng(map).first, 800 + 2 * 16);
  std::set<std::string> pictures = {map};
  for (const int poses : {0, 1, 100}) {
    WriteTrajectoryPicture(folder.path() / "trajectory.png", grid, OverlayOf(poses));
    pictures.insert(ReadFile(folder.path() / "trajectory.png"));
  }
  EXPECT_EQ(pictures.size(), 3U);  // Without a path it is the map.
  for (const std::string& picture : pictures) EXPECT_EQ(SizeOfPng(picture).first, 832);
}

TEST(Pictures, ShowThePathsOfAllWhereThereAreSeveral) {
  const TemporaryFolder folder;
  const OccupancyGrid grid = HalfKnownGrid(0.05);
  WriteMapPicture(folder.path() / "map.png", grid);
  const std::string map = ReadFile(folder.path() / "map.png");
  const auto picture_of = [&](std::vector<RobotPath> robots) {
    WriteTeamPicture(folder.path() / "team.png", grid, robots);
    return ReadFile(folder.path() / "team.png");
  };
  EXPECT_TRUE(picture_of({}) == map);
  EXPECT_TRUE(picture_of({{.robot = "nowhere", .path = {}}}) == map);
  const Trajectory path = TrajectoryOf(OverlayOf(100).path);
  std::vector<RobotPath> robots;
  std::set<std::string> pictures = {map};
  for (const std::string robot : {"", "robot_1", "robot_2"}) {
    robots.push_back({.robot = robot, .path = path});
    for (StampedPose2& pose : robots.back().path)
      pose.T_map_robot.y_m += 0.1 * static_cast<double>(robots.size());
    pictures.insert(picture_of(robots));
  }
  EXPECT_EQ(pictures.size(), 3U);  // Of one robot it is the map.
}

TEST(Pictures, AreTheSameForTheSameInput) {
  const TemporaryFolder folder;
  WriteTrajectoryPicture(folder.path() / "a.png", HalfKnownGrid(0.05), OverlayOf(50));
  WriteTrajectoryPicture(folder.path() / "b.png", HalfKnownGrid(0.05), OverlayOf(50));
  EXPECT_TRUE(ReadFile(folder.path() / "a.png") == ReadFile(folder.path() / "b.png"));
}

TEST(ResidualPlot, IsDrawnOfMuchAndOfNothing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<ResidualSeries>> cases = {
      {},
      {{.name = "Q-WSM", .residual_mm = {}}},
      {{.name = "Q-WSM", .residual_mm = {5.0}}},
      {{.name = "WSM", .residual_mm = {none, none}},
       {.name = "Q-WSM", .residual_mm = {5.0, none, 7.0}}},
      {{.name = "Q-WSM", .residual_mm = std::vector<double>(5000, 1e9)}}};
  const TemporaryFolder folder;
  std::set<std::string> pictures;
  for (const auto& series : cases) {
    WriteResidualPlot(folder.path() / "residual.png", series);
    pictures.insert(ReadFile(folder.path() / "residual.png"));
  }
  EXPECT_EQ(pictures.size(), cases.size());
}

}  // namespace
}  // namespace qwsm::io
