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

void Correct(std::vector<io::PathPose>& path, const Correction& correction) {
  for (std::size_t i = 0; i < path.size(); ++i) path[i].map_robot = correction.map_robot[i];
}

}  // namespace

ResultsWriter::ResultsWriter(const ResultsFolder& folder, const ResultsOptions& options)
    : folder_(folder),
      has_pictures_(options.pictures),
      trajectory_(folder / options.trajectory),
      table_(folder / ResultFile::kScans) {}

void ResultsWriter::Take(const TimedStep& timed) {
  trajectory_.Take(timed);
  table_.Take(timed);
  statistics_.Take(timed);
  history_.Take(timed);
  doubtful_.Take(timed);
}

void ResultsWriter::Finish(const ScanMap& map,
                           MatcherKind matcher,
                           const OccupancyGridOptions& rendering,
                           const Trajectory& truth) {
  trajectory_.Commit();
  table_.Commit();
  Drawing drawing{.scans = map.scans(), .overlay = std::move(history_).Overlay()};
  const std::vector<io::PathPose>& path = drawing.overlay.path;
  io::WriteKittiFile(folder_ / ResultFile::kTrajectoryKitti, io::TrajectoryOf(path));
  WriteFigures({.map = FiguresOf(map), .matcher = matcher, .path = path, .loops = {}}, truth);
  Draw(std::move(drawing), rendering);
}

void ResultsWriter::Finish(std::span<const RelevantScan> answered,
                           MatcherKind matcher,
                           const CorrectedRun& corrected,
                           const OccupancyGridOptions& rendering,
                           const Trajectory& truth) {
  trajectory_.Commit();
  table_.Commit();
  const Correction& correction = corrected.correction;
  Drawing drawing{.scans = corrected.scans,
                  .overlay = std::move(history_).Overlay(),
                  .correction = &correction};
  io::MapOverlay& overlay = drawing.overlay;
  overlay.answered = io::TrajectoryOf(overlay.path);
  Correct(overlay.path, correction);
  overlay.loops = LoopLines(correction);
  const std::vector<std::optional<UncertainPose2>> corrected_poses(correction.map_robot.begin(),
                                                                   correction.map_robot.end());
  AddCorrectedPoses(folder_ / ResultFile::kScans, corrected_poses);
  const Trajectory trajectory = io::TrajectoryOf(overlay.path);
  io::WriteTumFile(folder_ / ResultFile::kTrajectory, trajectory);
  io::WriteKittiFile(folder_ / ResultFile::kTrajectoryKitti, trajectory);
  WriteLoops(folder_.path(), correction, corrected.scans);
  WriteEpochs(folder_.path(), corrected);
  WriteFigures({.map = corrected.answered_in,
                .matcher = matcher,
                .path = overlay.path,
                .loops = CountLoops(correction, corrected.epochs.size())},
               truth);
  if (has_pictures_) drawing.before = RenderOrWarn(answered, rendering);
  Draw(std::move(drawing), rendering);
}

void ResultsWriter::WriteFigures(const Outcome& outcome, const Trajectory& truth) {
  if (!T_world_map_) T_world_map_ = TrueMapInWorld(outcome.path, truth);
  if (T_world_map_) truth_in_map_ = TruthInMap(truth, *T_world_map_);
  truth_report_ = CompareWithTruth(outcome.path, truth_in_map_);
  map_ = outcome.map;
  loops_ = outcome.loops;
  if (!truth_in_map_.empty()) io::WriteTumFile(folder_ / ResultFile::kTruth, truth_in_map_);
  metrics_ = MetricsJson(statistics_, outcome.map, outcome.matcher, truth_report_, outcome.loops);
  io::WriteTextFile(folder_ / ResultFile::kMetrics, metrics_.Text());
  if (!has_pictures_) return;
  const std::array<io::ResidualSeries, 1> series{
      {{.name = std::string(Name(outcome.matcher)), .residual_mm = history_.residuals_mm()}}};
  io::WriteResidualPlot(folder_ / ResultFile::kResiduals, series);
}

void ResultsWriter::Draw(Drawing drawing, const OccupancyGridOptions& rendering) const {
  drawing.overlay.truth = truth_in_map_;
  const std::optional<OccupancyGrid> grid = RenderOrWarn(drawing.scans, rendering);
  if (grid) io::WriteRosMap(folder_ / ResultFile::kMap, *grid);
  if (!has_pictures_) return;
  if (grid) {
    io::WriteMapPicture(folder_ / ResultFile::kMapPicture, *grid);
    io::WriteTrajectoryPicture(folder_ / ResultFile::kTrajectoryPicture, *grid, drawing.overlay);
  }
  if (drawing.before) io::WriteMapPicture(folder_ / ResultFile::kLiveMapPicture, *drawing.before);
  if (title_) WriteReport(drawing, grid ? &*grid : nullptr);
}

void ResultsWriter::WriteReport(const Drawing& drawing, const OccupancyGrid* grid) const {
  WriteMapReport(folder_ / ResultFile::kReport,
                 *title_,
                 {.metrics = metrics_,
                  .map = grid,
                  .before = drawing.before ? &*drawing.before : nullptr,
                  .overlay = drawing.overlay,
                  .residuals_mm = history_.residuals_mm(),
                  .times_ms = history_.times_ms(),
                  .doubtful = doubtful_.Worst(),
                  .correction = drawing.correction,
                  .relevant = drawing.scans});
}

std::optional<OccupancyGrid> RenderOrWarn(std::span<const RelevantScan> scans,
                                          OccupancyGridOptions rendering) {
  OccupancyGridResult result = RenderOccupancyGrid(scans, rendering);
  if (result.status == RenderStatus::kTooLarge && std::isfinite(result.smallest_cell_m)) {
    messages::Warn("the map of {:.0f} x {:.0f} m is drawn with cells of {:.2g} m, not {:.2g} m",
                   result.extent_x_m,
                   result.extent_y_m,
                   result.smallest_cell_m,
                   rendering.cell_m);
    rendering.cell_m = result.smallest_cell_m;
    result = RenderOccupancyGrid(scans, rendering);
  }
  if (result.status == RenderStatus::kRendered) return std::move(result.grid);
  messages::Warn("no map is drawn: {}",
                 result.status == RenderStatus::kNothingMeasured ? "no scan shows anything"
                                                                 : "it is too large");
  return std::nullopt;
}

}  // namespace qwsm::pipeline
