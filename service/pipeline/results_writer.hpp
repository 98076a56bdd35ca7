// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/pipeline/results_folder.hpp"
#include "service/pipeline/run_history.hpp"
#include "service/pipeline/run_statistics.hpp"
#include "service/pipeline/scan_table_sink.hpp"
#include "service/pipeline/trajectory_sink.hpp"

namespace qwsm::pipeline {

/// Leaves everything a run is to leave in its folder: trajectory and table as it goes, figures and
/// pictures at the end.
class ResultsWriter final : public StepSink {
 public:
  /// @throws io::WriteError, as do all others here.
  explicit ResultsWriter(const ResultsFolder& folder);

  void Take(const TimedStep& timed) override;

  /// Writes what can only be known at the end. Whatever cannot be drawn is warned of.
  void Finish(const Mapper& mapper, const OccupancyGridOptions& rendering);

  const RunStatistics& statistics() const { return statistics_; }

 private:
  void DrawMap(const Mapper& mapper, const OccupancyGridOptions& rendering) const;

  ResultsFolder folder_;
  TrajectorySink trajectory_;
  ScanTableSink table_;
  RunStatistics statistics_;
  RunHistory history_;
};

/// The map at the wanted cell size, or, with a warning, at the smallest one that can be rendered;
/// nothing where there is nothing to render.
std::optional<OccupancyGrid> RenderOrWarn(const ScanMap& map, OccupancyGridOptions rendering);

}  // namespace qwsm::pipeline
