// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "service/io/pictures/canvas.hpp"

namespace qwsm::io {

/// A sample of what was drawn, and what it means.
struct LegendItem {
  std::string label;
  double sample_width_px = 0.0;
  /// Draws the sample to the right of `left_px`, on the middle line of the label.
  std::function<void(Canvas& canvas, const Eigen::Vector2d& left_px)> draw_sample;
};

/// A legend item with a stretch of the line as it was drawn.
LegendItem LineItem(const std::string& label, const LineStyle& style);

/// A legend item of words only.
LegendItem TextItem(const std::string& label);

/// Legend items side by side, in as many lines as they need.
class Legend {
 public:
  /// Lays the items out within `width_px`.
  Legend(std::vector<LegendItem> items, double width_px);

  double height_px() const;
  void Draw(Canvas& canvas, const Eigen::Vector2d& corner_px) const;

 private:
  struct Placed {
    LegendItem item;
    Eigen::Vector2d left_px;  // Place relative to the corner, on the middle line.
  };
  std::vector<Placed> placed_;
  int lines_ = 0;
};

}  // namespace qwsm::io
