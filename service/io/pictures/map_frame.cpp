// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/map_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "service/io/pictures/axis.hpp"

namespace qwsm::io {
namespace {

constexpr int kMargin_px = 16;
constexpr int kNarrowest_px = 640;  // So that a legend fits below a narrow map.
constexpr Color kFrameColor = FromBytes(170, 176, 186);
constexpr Color kScaleColor = FromBytes(40, 46, 56);

int CanvasWidth(const MapView& view) {
  return std::max(view.width_px() + 2 * kMargin_px, kNarrowest_px);
}

LegendItem ScaleItem(double px_per_m) {
  constexpr double kAbout_px = 60.0;
  constexpr double kHalfHeight_px = 5.0;
  const double length_m = RoundUpToNice(kAbout_px / px_per_m);
  const double length_px = length_m * px_per_m;
  return {.label = LengthLabel(length_m),
          .sample_width_px = length_px,
          .draw_sample = [length_px](Canvas& canvas, const Eigen::Vector2d& left_px) {
            const Eigen::Vector2d right_px = left_px + Eigen::Vector2d(length_px, 0.0);
            const Eigen::Vector2d up_px(0.0, -kHalfHeight_px);
            const LineStyle style{.color = kScaleColor, .width_px = 2.0};
            canvas.StrokeLine(left_px, right_px, style);
            canvas.StrokeLine(left_px - up_px, left_px + up_px, style);
            canvas.StrokeLine(right_px - up_px, right_px + up_px, style);
          }};
}

std::string ExtentLabel(const OccupancyGrid& grid) {
  const auto metres = [&](int cells) {
    const double length_m = cells * grid.cell_m;
    return TickLabel(length_m, length_m < 10.0 ? 0.1 : 1.0);
  };
  return metres(grid.width) + " \u00d7 " + metres(grid.height) + " m";
}

Legend LegendFor(const OccupancyGrid& grid, const MapView& view, std::vector<LegendItem> items) {
  std::vector<LegendItem> all = {ScaleItem(view.px_per_m()),
                                 TextItem("grid " + LengthLabel(view.grid_step_m())),
                                 TextItem(ExtentLabel(grid))};
  std::ranges::move(items, std::back_inserter(all));
  return {std::move(all), static_cast<double>(CanvasWidth(view) - 2 * kMargin_px)};
}

void DrawBorder(Canvas& canvas, const Rectangle& area) {
  const Eigen::Vector2d low_px = area.corner_px.array() - 0.5;
  const Eigen::Vector2d high_px = (area.corner_px + area.size_px).array() + 0.5;
  const std::array<Eigen::Vector2d, 5> corners_px = {low_px,
                                                     Eigen::Vector2d(high_px.x(), low_px.y()),
                                                     high_px,
                                                     Eigen::Vector2d(low_px.x(), high_px.y()),
                                                     low_px};
  canvas.Stroke(corners_px, {.color = kFrameColor, .width_px = 1.0});
}

}  // namespace

MapFrame::MapFrame(const OccupancyGrid& grid, const MapView& view, std::vector<LegendItem> items)
    : MapFrame(grid, view, LegendFor(grid, view, std::move(items))) {}

MapFrame::MapFrame(const OccupancyGrid& grid, const MapView& view, const Legend& legend)
    : view_(view),
      canvas_(CanvasWidth(view),
              view.height_px() + 3 * kMargin_px + static_cast<int>(std::ceil(legend.height_px()))),
      corner_px_((canvas_.width_px() - view.width_px()) / 2, kMargin_px) {
  canvas_.Draw(RenderMap(grid, view), corner_px_);
  DrawBorder(canvas_, map_area());
  legend.Draw(canvas_, {kMargin_px, view.height_px() + 2.0 * kMargin_px});
}

}  // namespace qwsm::io
