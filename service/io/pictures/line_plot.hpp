// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "service/io/pictures/canvas.hpp"

namespace qwsm::io {

/// A line through points (x, y), with a gap where y is not a number.
struct PlotSeries {
  std::string label;
  Color color;
  /// Whether the area under the line is filled, down to the lower end of the plot.
  bool filled = false;
  std::vector<Eigen::Vector2d> points;
};

/// Lines over one pair of axes; each series is drawn in front of those before it.
struct LinePlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
};

/// Draws the plot. Both axes start at zero if nothing lies below; y ends where it shows 99.5 % of
/// the values of every series well, so that one outlier does not flatten the rest, and higher peaks
/// are cut off. The file is a PNG or an SVG, as its name ends.
/// @throws std::invalid_argument for another ending, WriteError where it cannot be written.
void WriteLinePlot(const std::filesystem::path& path, const LinePlot& plot);

}  // namespace qwsm::io
