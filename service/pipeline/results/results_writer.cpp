// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/results_writer.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/io/pictures/residual_plot.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/run_report.hpp"

namespace qwsm::pipeline {

ResultsWriter::ResultsWriter(const ResultsFolder& folder)
    : folder_(folder), trajectory_(folder / "trajectory.tum"), table_(folder / "scans.csv") {}

void ResultsWriter::Take(const TimedStep& timed) {
  trajectory_.Take(timed);
  table_.Take(timed);
  statistics_.Take(timed);
  history_.Take(timed);
}

void ResultsWriter::Finish(const Mapper& mapper,
                           const OccupancyGridOptions& rendering,
                           const Trajectory& truth) {
  trajectory_.Commit();
  table_.Commit();
  const MatcherKind matcher = mapper.options().matcher;
  const std::vector<io::PathPose>& path = history_.path();
  const Trajectory truth_in_map = TruthInMap(path, truth);
  truth_report_ = CompareWithTruth(path, truth);
  if (!truth_in_map.empty()) io::WriteTumFile(folder_ / "truth.tum", truth_in_map);
  io::WriteTextFile(folder_ / "metrics.json",
                    MetricsJson(statistics_, mapper.map(), matcher, truth_report_));
  const std::array<io::ResidualSeries, 1> series{
      {{.name = std::string(Name(matcher)), .residual_mm = history_.residuals_mm()}}};
  io::WriteResidualPlot(folder_ / "residual.png", series);
  DrawMap(mapper, rendering, truth_in_map);
}

void ResultsWriter::DrawMap(const Mapper& mapper,
                            const OccupancyGridOptions& rendering,
                            Trajectory truth_in_map) const {
  const std::optional<OccupancyGrid> grid = RenderOrWarn(mapper.map(), rendering);
  if (!grid) return;
  io::WriteRosMap(folder_ / "map.yaml", *grid);
  io::WriteMapPicture(folder_ / "map.png", *grid);
  io::MapOverlay overlay = history_.Overlay();
  overlay.truth = std::move(truth_in_map);
  io::WriteTrajectoryPicture(folder_ / "trajectory.png", *grid, overlay);
}

std::optional<OccupancyGrid> RenderOrWarn(const ScanMap& map, OccupancyGridOptions rendering) {
  OccupancyGridResult result = RenderOccupancyGrid(map.scans(), rendering);
  if (result.status == RenderStatus::kTooLarge && std::isfinite(result.smallest_cell_m)) {
    spdlog::warn("the map of {:.0f} x {:.0f} m is drawn with cells of {:.2g} m, not {:.2g} m",
                 result.extent_x_m,
                 result.extent_y_m,
                 result.smallest_cell_m,
                 rendering.cell_m);
    rendering.cell_m = result.smallest_cell_m;
    result = RenderOccupancyGrid(map.scans(), rendering);
  }
  if (result.status == RenderStatus::kRendered) return std::move(result.grid);
  spdlog::warn("no map is drawn: {}",
               result.status == RenderStatus::kNothingMeasured ? "no scan shows anything"
                                                               : "it is too large");
  return std::nullopt;
}

}  // namespace qwsm::pipeline
