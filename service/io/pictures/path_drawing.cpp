// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/path_drawing.hpp"

#include <array>
#include <cmath>

#include "service/io/pictures/map_colors.hpp"

namespace qwsm::io {
namespace {

constexpr Color kStartEdge = FromBytes(90, 70, 0);

// y points down on the canvas.
void DrawArrow(Canvas& canvas, const Eigen::Vector2d& at_px, double heading_rad) {
  const Eigen::Vector2d ahead(std::cos(heading_rad), -std::sin(heading_rad));
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const std::array<Eigen::Vector2d, 4> corners_px = {at_px + 14.0 * ahead,
                                                     at_px - 8.0 * ahead + 9.0 * left,
                                                     at_px - 4.0 * ahead,
                                                     at_px - 8.0 * ahead - 9.0 * left};
  canvas.FillPolygon(corners_px, map_colors::kStart);
  std::vector<Eigen::Vector2d> outline_px(corners_px.begin(), corners_px.end());
  outline_px.push_back(outline_px.front());
  canvas.Stroke(outline_px, {.color = kStartEdge, .width_px = 1.2});
}

}  // namespace

std::vector<Eigen::Vector2d> OnCanvas(const MapFrame& frame,
                                      std::span<const Eigen::Vector2d> path_map_m) {
  constexpr double kLeastStep_px = 1.0;
  std::vector<Eigen::Vector2d> points_px;
  for (const Eigen::Vector2d& place_m : path_map_m) {
    const Eigen::Vector2d point_px = frame.ToCanvas(place_m);
    const bool is_last = &place_m == &path_map_m.back();
    if (points_px.empty() || is_last || (point_px - points_px.back()).norm() >= kLeastStep_px) {
      points_px.push_back(point_px);
    }
  }
  return points_px;
}

void DrawStart(MapFrame& frame, const Pose2& T_map_robot) {
  DrawArrow(frame.canvas(), frame.ToCanvas(T_map_robot.translation_m()), T_map_robot.theta_rad);
}

LegendItem StartItem() {
  return {.label = "start",
          .sample_width_px = 22.0,
          .draw_sample = [](Canvas& canvas, const Eigen::Vector2d& left_px) {
            DrawArrow(canvas, left_px + Eigen::Vector2d(8.0, 0.0), 0.0);
          }};
}

}  // namespace qwsm::io
