// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/pipeline/results/corrected_run.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/results/run_history.hpp"
#include "service/pipeline/results/run_statistics.hpp"
#include "service/pipeline/results/scan_table_sink.hpp"
#include "service/pipeline/results/trajectory_sink.hpp"
#include "service/pipeline/results/truth_report.hpp"

namespace qwsm::pipeline {

/// Leaves everything a run is to leave in its folder: trajectory and table as it goes, figures and
/// pictures at the end.
class ResultsWriter final : public StepSink {
 public:
  /// Begins the results in a folder.
  /// @throws io::WriteError, as all functions of the class do.
  /// @param trajectory name of the file for the poses as they were answered.
  explicit ResultsWriter(const ResultsFolder& folder,
                         std::string_view trajectory = "trajectory.tum");

  void Take(const TimedStep& timed) override;

  /// Writes what can only be known at the end. Whatever cannot be drawn is warned of.
  /// @param truth of the robot in a frame of its own; empty where it is not known.
  void Finish(const ScanMap& map,
              MatcherKind matcher,
              const OccupancyGridOptions& rendering,
              const Trajectory& truth = {});
  /// Writes what can only be known at the end of a corrected run: the corrected poses are the
  /// trajectory, and the map is that of the scans there; the map as it was goes into map_live.png.
  void Finish(const Mapper& mapper,
              const CorrectedRun& corrected,
              const OccupancyGridOptions& rendering,
              const Trajectory& truth = {});

  const RunStatistics& statistics() const { return statistics_; }
  /// Counts of loops, after Finish() of a corrected run.
  const std::optional<LoopCounts>& loops() const { return loops_; }
  /// The report on the truth, after Finish(), where the truth is known.
  const std::optional<TruthReport>& truth_report() const { return truth_report_; }

 private:
  // What is known at the end of a run.
  struct Outcome {
    const ScanMap& map;
    MatcherKind matcher;
    std::span<const io::PathPose> path;
    std::optional<LoopCounts> loops{};
  };

  void Report(const Outcome& outcome, const Trajectory& truth);
  void DrawMap(const ScanMap& map,
               const OccupancyGridOptions& rendering,
               const io::MapOverlay& overlay) const;
  std::vector<io::PathPose> CorrectedPath(const Correction& correction) const;

  ResultsFolder folder_;
  TrajectorySink trajectory_;
  ScanTableSink table_;
  RunStatistics statistics_;
  RunHistory history_;
  Trajectory truth_in_map_;
  std::optional<TruthReport> truth_report_;
  std::optional<LoopCounts> loops_;
};

/// The map at the wanted cell size, or, with a warning, at the smallest one that can be rendered;
/// nothing where there is nothing to render.
std::optional<OccupancyGrid> RenderOrWarn(const ScanMap& map, OccupancyGridOptions rendering);

}  // namespace qwsm::pipeline
