// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/line_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "service/io/pictures/axis.hpp"
#include "service/io/pictures/legend.hpp"

namespace qwsm::io {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr int kWidth_px = 1200;
constexpr int kHeight_px = 560;
constexpr double kLeft_px = 86.0;
constexpr double kRight_px = 28.0;
constexpr double kTitle_px = 30.0;
constexpr double kGap_px = 14.0;
constexpr double kBottom_px = 70.0;

constexpr Color kInk = FromBytes(40, 46, 56);
constexpr Color kAxis = FromBytes(120, 126, 136);
constexpr Color kGridLine = FromBytes(228, 231, 236);
constexpr double kFillTint = 0.3;

// `share` of one colour in another.
Color Mixed(const Color& color, const Color& other, double share) {
  const auto mix = [share](double a, double b) { return share * a + (1.0 - share) * b; };
  return {mix(color.red, other.red), mix(color.green, other.green), mix(color.blue, other.blue)};
}

struct Range {
  double low = 0.0;
  double high = 1.0;
};

// From zero, or below if any value is; up to `high`.
Range RangeOver(const std::vector<double>& values, double high) {
  double low = 0.0;
  for (const double value : values) low = std::min(low, value);
  return {low, high > low ? high : low + 1.0};
}

// The value that `share` of them are not above; 0 for none.
double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  const double last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

std::vector<double> FiniteCoordinates(const PlotSeries& series, int axis) {
  std::vector<double> values;
  for (const Eigen::Vector2d& point : series.points) {
    if (point.allFinite()) values.push_back(point[axis]);
  }
  return values;
}

Range RangeOfX(const LinePlot& plot) {
  std::vector<double> all;
  for (const PlotSeries& series : plot.series)
    std::ranges::copy(FiniteCoordinates(series, 0), std::back_inserter(all));
  return RangeOver(all, Quantile(all, 1.0));
}

Range RangeOfY(const LinePlot& plot) {
  constexpr double kShareShown = 0.995;
  constexpr double kHeadroom = 1.15;
  std::vector<double> all;
  double high = 0.0;
  for (const PlotSeries& series : plot.series) {
    const std::vector<double> values = FiniteCoordinates(series, 1);
    high = std::max(high, kHeadroom * Quantile(values, kShareShown));
    std::ranges::copy(values, std::back_inserter(all));
  }
  return RangeOver(all, high);
}

Legend LegendOf(const LinePlot& plot) {
  std::vector<LegendItem> items;
  for (const PlotSeries& series : plot.series) {
    items.push_back(LineItem(series.label, {.color = series.color, .width_px = 3.0}));
  }
  return {std::move(items), kWidth_px - kLeft_px - kRight_px};
}

class PlotPainter {
 public:
  explicit PlotPainter(const LinePlot& plot)
      : plot_(plot),
        x_(RangeOfX(plot)),
        y_(RangeOfY(plot)),
        legend_(LegendOf(plot)),
        area_{.corner_px = {kLeft_px, kTitle_px + legend_.height_px() + 2.0 * kGap_px},
              .size_px = {kWidth_px - kLeft_px - kRight_px, 0.0}} {
    area_.size_px.y() = kHeight_px - kBottom_px - area_.corner_px.y();
  }

  void Paint() {
    canvas_.Write(plot_.title,
                  {kLeft_px, kGap_px + 0.5 * kTitle_px},
                  {.color = kInk, .size_px = 18.0, .bold = true});
    legend_.Draw(canvas_, {kLeft_px, kGap_px + kTitle_px});
    PaintTicksOfX();
    PaintTicksOfY();
    canvas_.Clip(area_);
    for (const PlotSeries& series : plot_.series) PaintFill(series);
    for (const PlotSeries& series : plot_.series) PaintLine(series);
    canvas_.Unclip();
    PaintAxes();
  }

  const Canvas& canvas() const { return canvas_; }

 private:
  double left_px() const { return area_.corner_px.x(); }
  double right_px() const { return left_px() + area_.size_px.x(); }
  double top_px() const { return area_.corner_px.y(); }
  double bottom_px() const { return top_px() + area_.size_px.y(); }

  Eigen::Vector2d ToCanvas(const Eigen::Vector2d& point) const {
    const double right = (point.x() - x_.low) / (x_.high - x_.low);
    const double up = (point.y() - y_.low) / (y_.high - y_.low);
    return {left_px() + right * area_.size_px.x(), bottom_px() - up * area_.size_px.y()};
  }

  void PaintTicksOfX() {
    constexpr int kAboutTicks = 10;
    const std::vector<double> ticks = Ticks(x_.low, x_.high, kAboutTicks);
    const double step = RoundUpToNice((x_.high - x_.low) / kAboutTicks);
    for (const double tick : ticks) {
      const double x_px = std::round(ToCanvas({tick, y_.low}).x()) + 0.5;
      Line({x_px, top_px()}, {x_px, bottom_px()}, kGridLine);
      canvas_.Write(TickLabel(tick, step),
                    {x_px, bottom_px() + 17.0},
                    {.color = kInk, .alignment = TextAlignment::kCenter});
    }
    canvas_.Write(plot_.x_label,
                  {0.5 * (left_px() + right_px()), bottom_px() + 46.0},
                  {.color = kInk, .size_px = 15.0, .alignment = TextAlignment::kCenter});
  }

  void PaintTicksOfY() {
    constexpr int kAboutTicks = 6;
    const std::vector<double> ticks = Ticks(y_.low, y_.high, kAboutTicks);
    const double step = RoundUpToNice((y_.high - y_.low) / kAboutTicks);
    for (const double tick : ticks) {
      const double y_px = std::round(ToCanvas({x_.low, tick}).y()) + 0.5;
      Line({left_px(), y_px}, {right_px(), y_px}, kGridLine);
      canvas_.Write(TickLabel(tick, step),
                    {left_px() - 9.0, y_px},
                    {.color = kInk, .alignment = TextAlignment::kRight});
    }
    canvas_.Write(
        plot_.y_label,
        {22.0, 0.5 * (top_px() + bottom_px())},
        {.color = kInk, .size_px = 15.0, .alignment = TextAlignment::kCenter, .upwards = true});
  }

  // What is drawn without a gap, on the canvas.
  std::vector<Points> Stretches(const PlotSeries& series) const {
    std::vector<Points> stretches_px(1);
    for (const Eigen::Vector2d& point : series.points) {
      if (point.allFinite()) {
        stretches_px.back().push_back(ToCanvas(point));
      } else if (!stretches_px.back().empty()) {
        stretches_px.emplace_back();
      }
    }
    if (stretches_px.back().empty()) stretches_px.pop_back();
    return stretches_px;
  }

  // Opaque, so that what is behind stays behind.
  void PaintFill(const PlotSeries& series) {
    if (!series.filled) return;
    const Color tint = Mixed(series.color, {1.0, 1.0, 1.0}, kFillTint);
    for (Points& outline_px : Stretches(series)) {
      outline_px.emplace_back(outline_px.back().x(), bottom_px());
      outline_px.emplace_back(outline_px.front().x(), bottom_px());
      canvas_.FillPolygon(outline_px, tint);
    }
  }

  // All lines are on top of all fills: where the front one is higher, the others are seen.
  void PaintLine(const PlotSeries& series) {
    const bool crowded = static_cast<double>(series.points.size()) > area_.size_px.x();
    const LineStyle style{.color = series.color, .width_px = crowded ? 1.0 : 1.6};
    for (const Points& stretch_px : Stretches(series)) canvas_.Stroke(stretch_px, style);
  }

  void PaintAxes() {
    Line({left_px(), top_px()}, {left_px(), bottom_px()}, kAxis);
    Line({left_px(), bottom_px()}, {right_px(), bottom_px()}, kAxis);
  }

  void Line(const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px, const Color& color) {
    canvas_.StrokeLine(from_px, to_px, {.color = color, .width_px = 1.0});
  }

  const LinePlot& plot_;
  Range x_;
  Range y_;
  Legend legend_;
  Rectangle area_;
  Canvas canvas_{kWidth_px, kHeight_px};
};

}  // namespace

void WriteLinePlot(const std::filesystem::path& path, const LinePlot& plot) {
  PlotPainter painter(plot);
  painter.Paint();
  painter.canvas().Save(path);
}

}  // namespace qwsm::io
