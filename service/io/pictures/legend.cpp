// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/legend.hpp"

#include <utility>

namespace qwsm::io {
namespace {

constexpr double kLineHeight_px = 26.0;
constexpr double kLineSample_px = 30.0;
constexpr double kSampleToLabel_px = 8.0;
constexpr double kBetweenItems_px = 28.0;
const TextStyle kLabelStyle{.color = FromBytes(40, 46, 56), .size_px = 15.0};

double LabelOffset(const LegendItem& item) {
  return item.sample_width_px > 0.0 ? item.sample_width_px + kSampleToLabel_px : 0.0;
}

}  // namespace

LegendItem LineItem(const std::string& label, const LineStyle& style) {
  return {.label = label,
          .sample_width_px = kLineSample_px,
          .draw_sample = [style](Canvas& canvas, const Eigen::Vector2d& left_px) {
            canvas.StrokeLine(left_px, left_px + Eigen::Vector2d(kLineSample_px, 0.0), style);
          }};
}

LegendItem TextItem(const std::string& label) {
  return {.label = label, .draw_sample = [](Canvas&, const Eigen::Vector2d&) {}};
}

Legend::Legend(std::vector<LegendItem> items, double width_px) {
  const Canvas ruler(1, 1);
  double x_px = 0.0;
  for (LegendItem& item : items) {
    const double item_px = LabelOffset(item) + ruler.TextWidth(item.label, kLabelStyle);
    if (lines_ == 0 || x_px + item_px > width_px) {
      ++lines_;
      x_px = 0.0;
    }
    placed_.push_back(
        {.item = std::move(item), .left_px = {x_px, (lines_ - 0.5) * kLineHeight_px}});
    x_px += item_px + kBetweenItems_px;
  }
}

double Legend::height_px() const { return lines_ * kLineHeight_px; }

void Legend::Draw(Canvas& canvas, const Eigen::Vector2d& corner_px) const {
  for (const Placed& placed : placed_) {
    const Eigen::Vector2d left_px = corner_px + placed.left_px;
    placed.item.draw_sample(canvas, left_px);
    canvas.Write(
        placed.item.label, left_px + Eigen::Vector2d(LabelOffset(placed.item), 0.0), kLabelStyle);
  }
}

}  // namespace qwsm::io
