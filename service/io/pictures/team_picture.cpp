// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/team_picture.hpp"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "service/io/pictures/map_frame.hpp"
#include "service/io/pictures/path_drawing.hpp"

namespace qwsm::io {
namespace {

// Those of the live page, in the same order: also who cannot tell red from green tells them apart.
constexpr std::array kRobotColors = {FromBytes(0, 114, 178),
                                     FromBytes(230, 159, 0),
                                     FromBytes(0, 158, 115),
                                     FromBytes(204, 121, 167),
                                     FromBytes(86, 180, 233),
                                     FromBytes(213, 94, 0),
                                     FromBytes(240, 228, 66),
                                     FromBytes(140, 140, 140)};

// Of lines upon each other, the narrowest on top: where robots took the same way all are seen.
constexpr std::array kWidths_px = {8.8, 6.8, 4.8, 2.8};

// A robot's path, and how it is drawn.
struct Line {
  const RobotPath* robot;
  std::vector<Eigen::Vector2d> places_m;
  LineStyle style;
};

std::vector<Eigen::Vector2d> PositionsAlong(const RobotPath& robot) {
  std::vector<Eigen::Vector2d> places_m;
  places_m.reserve(robot.path.size());
  for (const StampedPose2& pose : robot.path) {
    places_m.push_back(pose.T_map_robot.translation_m());
  }
  return places_m;
}

std::vector<Line> LinesOf(std::span<const RobotPath> robots) {
  std::vector<Line> lines;
  for (const RobotPath& robot : robots) {
    if (robot.path.empty()) continue;
    const bool is_again = lines.size() / kRobotColors.size() % 2 == 1;
    const LineStyle style{.color = kRobotColors[lines.size() % kRobotColors.size()],
                          .width_px = kWidths_px[lines.size() % kWidths_px.size()],
                          .dash_px = is_again ? 7.0 : 0.0};
    lines.push_back({.robot = &robot, .places_m = PositionsAlong(robot), .style = style});
  }
  if (lines.size() < 2) lines.clear();
  return lines;
}

std::vector<LegendItem> ItemsOf(std::span<const Line> lines) {
  std::vector<LegendItem> items;
  for (const Line& line : lines) {
    const std::string& name = line.robot->robot;
    items.push_back(LineItem(name.empty() ? "path" : name, line.style));
  }
  if (!lines.empty()) items.push_back(StartItem());
  return items;
}

MapView ViewOfTeam(const OccupancyGrid& grid, std::span<const Line> lines) {
  Eigen::Vector2d low_m = grid.origin_map_m;
  Eigen::Vector2d high_m = grid.origin_map_m;
  for (const Line& line : lines) {
    for (const Eigen::Vector2d& place_m : line.places_m) {
      low_m = low_m.cwiseMin(place_m);
      high_m = high_m.cwiseMax(place_m);
    }
  }
  return {grid, low_m, high_m};
}

}  // namespace

void WriteTeamPicture(const std::filesystem::path& path,
                      const OccupancyGrid& grid,
                      std::span<const RobotPath> robots) {
  const std::vector<Line> lines = LinesOf(robots);
  MapFrame frame(grid, ViewOfTeam(grid, lines), ItemsOf(lines));
  frame.canvas().Clip(frame.map_area());
  for (const double width_px : kWidths_px) {
    for (const Line& line : lines) {
      if (line.style.width_px != width_px) continue;
      frame.canvas().Stroke(OnCanvas(frame, line.places_m), line.style);
    }
  }
  for (const Line& line : lines) DrawStart(frame, line.robot->path.front().T_map_robot);
  frame.canvas().Unclip();
  frame.canvas().Save(path);
}

}  // namespace qwsm::io
