// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/pipeline/report/doubtful_scans.hpp"
#include "service/pipeline/report/report_page.hpp"
#include "service/pipeline/results/corrected_run.hpp"

namespace qwsm::pipeline {

/// What a report shows of a run in the plane; all of it is in the frame `map`.
struct MapReport {
  Json metrics;                        ///< Figures, as MetricsJson() gives them.
  const OccupancyGrid* map = nullptr;  ///< The map in the end; none where there is nothing to draw.
  const OccupancyGrid* before =
      nullptr;  ///< The map before it was corrected; none where it was not.
  const io::MapOverlay& overlay;
  std::span<const double> residuals_mm;  ///< Residual of each scan; NaN where there was no match.
  std::span<const double> times_ms;      ///< Time of each scan.
  std::vector<DoubtfulScan> doubtful;    ///< The scans to look at, the worst first.
  const Correction* correction = nullptr;
  std::span<const RelevantScan> relevant;  ///< The scans between which the loops are.
};

/// Writes the report of a run as one page of HTML that needs no other file. Of runs of more than
/// kMostRows scans, the page holds of neighbouring scans the one with the largest residual.
/// @throws io::WriteError.
inline constexpr std::size_t kMostRows = 40'000;
void WriteMapReport(const std::filesystem::path& path,
                    const RunTitle& title,
                    const MapReport& report);

}  // namespace qwsm::pipeline
