// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "qwsm/mapping/occupancy_grid.hpp"
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
  /// @throws io::WriteError, as do all others here.
  explicit ResultsWriter(const ResultsFolder& folder);

  void Take(const TimedStep& timed) override;

  /// Writes what can only be known at the end. Whatever cannot be drawn is warned of.
  /// @param truth of the robot in a frame of its own; empty where it is not known.
  void Finish(const Mapper& mapper,
              const OccupancyGridOptions& rendering,
              const Trajectory& truth = {});

  const RunStatistics& statistics() const { return statistics_; }
  /// After Finish(), where the truth is known.
  const std::optional<TruthReport>& truth_report() const { return truth_report_; }

 private:
  void DrawMap(const Mapper& mapper,
               const OccupancyGridOptions& rendering,
               Trajectory truth_in_map) const;

  ResultsFolder folder_;
  TrajectorySink trajectory_;
  ScanTableSink table_;
  RunStatistics statistics_;
  RunHistory history_;
  std::optional<TruthReport> truth_report_;
};

/// The map at the wanted cell size, or, with a warning, at the smallest one that can be rendered;
/// nothing where there is nothing to render.
std::optional<OccupancyGrid> RenderOrWarn(const ScanMap& map, OccupancyGridOptions rendering);

}  // namespace qwsm::pipeline
