// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/results_writer.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "service/io/files/atomic_file.hpp"
#include "service/io/maps/ros_map_file.hpp"
#include "service/io/pictures/map_picture.hpp"
#include "service/io/pictures/residual_plot.hpp"
#include "service/io/trajectories/trajectory_file.hpp"
#include "service/pipeline/results/run_report.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {
namespace {

Trajectory TrajectoryOf(std::span<const io::PathPose> path) {
  Trajectory trajectory;
  trajectory.reserve(path.size());
  for (const io::PathPose& pose : path) {
    trajectory.push_back({.stamp = pose.stamp, .T_map_robot = pose.map_robot.T_a_b});
  }
  return trajectory;
}

}  // namespace

ResultsWriter::ResultsWriter(const ResultsFolder& folder, std::string_view trajectory)
    : folder_(folder), trajectory_(folder / trajectory), table_(folder / "scans.csv") {}

void ResultsWriter::Take(const TimedStep& timed) {
  trajectory_.Take(timed);
  table_.Take(timed);
  statistics_.Take(timed);
  history_.Take(timed);
}

void ResultsWriter::Finish(const ScanMap& map,
                           MatcherKind matcher,
                           const OccupancyGridOptions& rendering,
                           const Trajectory& truth) {
  trajectory_.Commit();
  table_.Commit();
  Report({.map = map, .matcher = matcher, .path = history_.path(), .loops = {}}, truth);
  io::MapOverlay overlay = history_.Overlay();
  overlay.truth = truth_in_map_;
  DrawMap(map, rendering, overlay);
}

void ResultsWriter::Finish(const Mapper& mapper,
                           const CorrectedRun& corrected,
                           const OccupancyGridOptions& rendering,
                           const Trajectory& truth) {
  trajectory_.Commit();
  table_.Commit();
  const Correction& correction = corrected.correction;
  io::MapOverlay overlay = history_.Overlay();
  overlay.answered = TrajectoryOf(overlay.path);
  overlay.path = CorrectedPath(correction);
  overlay.loops = LoopLines(correction);
  AddCorrectedPoses(folder_ / "scans.csv", correction.map_robot);
  io::WriteTumFile(folder_ / "trajectory.tum", TrajectoryOf(overlay.path));
  WriteLoops(folder_, correction, corrected.map);
  Report({.map = corrected.map,
          .matcher = mapper.options().matcher,
          .path = overlay.path,
          .loops = CountLoops(correction.loops)},
         truth);
  overlay.truth = truth_in_map_;
  DrawMap(corrected.map, rendering, overlay);
  const auto before = RenderOrWarn(mapper.map(), rendering);
  if (before) io::WriteMapPicture(folder_ / "map_live.png", *before);
}

std::vector<io::PathPose> ResultsWriter::CorrectedPath(const Correction& correction) const {
  std::vector<io::PathPose> path = history_.path();
  for (std::size_t i = 0; i < path.size(); ++i) path[i].map_robot = correction.map_robot[i];
  return path;
}

void ResultsWriter::Report(const Outcome& outcome, const Trajectory& truth) {
  truth_in_map_ = TruthInMap(outcome.path, truth);
  truth_report_ = CompareWithTruth(outcome.path, truth);
  loops_ = outcome.loops;
  if (!truth_in_map_.empty()) io::WriteTumFile(folder_ / "truth.tum", truth_in_map_);
  io::WriteTextFile(
      folder_ / "metrics.json",
      MetricsJson(statistics_, outcome.map, outcome.matcher, truth_report_, outcome.loops).Text());
  const std::array<io::ResidualSeries, 1> series{
      {{.name = std::string(Name(outcome.matcher)), .residual_mm = history_.residuals_mm()}}};
  io::WriteResidualPlot(folder_ / "residual.png", series);
}

void ResultsWriter::DrawMap(const ScanMap& map,
                            const OccupancyGridOptions& rendering,
                            const io::MapOverlay& overlay) const {
  const std::optional<OccupancyGrid> grid = RenderOrWarn(map, rendering);
  if (!grid) return;
  io::WriteRosMap(folder_ / "map.yaml", *grid);
  io::WriteMapPicture(folder_ / "map.png", *grid);
  io::WriteTrajectoryPicture(folder_ / "trajectory.png", *grid, overlay);
}

std::optional<OccupancyGrid> RenderOrWarn(const ScanMap& map, OccupancyGridOptions rendering) {
  OccupancyGridResult result = RenderOccupancyGrid(map.scans(), rendering);
  if (result.status == RenderStatus::kTooLarge && std::isfinite(result.smallest_cell_m)) {
    messages::Warn("the map of {:.0f} x {:.0f} m is drawn with cells of {:.2g} m, not {:.2g} m",
                   result.extent_x_m,
                   result.extent_y_m,
                   result.smallest_cell_m,
                   rendering.cell_m);
    rendering.cell_m = result.smallest_cell_m;
    result = RenderOccupancyGrid(map.scans(), rendering);
  }
  if (result.status == RenderStatus::kRendered) return std::move(result.grid);
  messages::Warn("no map is drawn: {}",
                 result.status == RenderStatus::kNothingMeasured ? "no scan shows anything"
                                                                 : "it is too large");
  return std::nullopt;
}

}  // namespace qwsm::pipeline
