// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace qwsm::io {

/// How far matched points stayed apart, scan by scan.
struct ResidualSeries {
  std::string name;                 ///< Name of the matcher.
  std::vector<double> residual_mm;  ///< Residual of each scan; NaN where there was no match.
};

/// Draws Figure 4 of Visser et al. (2009): the residual correspondence distance over the number of
/// the scan, each series in front of those before it, with the averages in the legend. The file is
/// a PNG or an SVG, as its name ends.
/// @throws std::invalid_argument for another ending, WriteError where it cannot be written.
void WriteResidualPlot(const std::filesystem::path& path, std::span<const ResidualSeries> series);

}  // namespace qwsm::io
