// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/residual_plot.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "service/io/pictures/line_plot.hpp"

namespace qwsm::io {
namespace {

// From the back to the front: the last series is the dark blue one.
constexpr std::array kColors = {
    FromBytes(150, 155, 165), FromBytes(235, 140, 40), FromBytes(0, 80, 170)};

Color ColorOf(std::size_t index, std::size_t count) {
  const std::size_t from_front = count - 1 - index;
  return kColors[kColors.size() - 1 - from_front % kColors.size()];
}

std::string LabelWithMean(const ResidualSeries& series) {
  double sum_mm = 0.0;
  int count = 0;
  for (const double residual_mm : series.residual_mm) {
    if (!std::isfinite(residual_mm)) continue;
    sum_mm += residual_mm;
    ++count;
  }
  if (count == 0) return series.name + ", no match";
  std::array<char, 64> mean{};
  std::snprintf(mean.data(), mean.size(), ", mean %.2f mm", sum_mm / count);
  return series.name + mean.data();
}

}  // namespace

void WriteResidualPlot(const std::filesystem::path& path, std::span<const ResidualSeries> series) {
  LinePlot plot{.title = "Residual correspondence distance",
                .x_label = "scan",
                .y_label = "mean distance (mm)",
                .series = {}};
  for (std::size_t i = 0; i < series.size(); ++i) {
    PlotSeries line{.label = LabelWithMean(series[i]),
                    .color = ColorOf(i, series.size()),
                    .filled = true,
                    .points = {}};
    for (std::size_t scan = 0; scan < series[i].residual_mm.size(); ++scan) {
      line.points.emplace_back(static_cast<double>(scan), series[i].residual_mm[scan]);
    }
    plot.series.push_back(std::move(line));
  }
  WriteLinePlot(path, plot);
}

}  // namespace qwsm::io
