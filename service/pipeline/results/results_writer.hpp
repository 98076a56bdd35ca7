// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/pipeline/report/doubtful_scans.hpp"
#include "service/pipeline/report/map_report.hpp"
#include "service/pipeline/report/report_page.hpp"
#include "service/pipeline/results/corrected_run.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/results/run_history.hpp"
#include "service/pipeline/results/run_statistics.hpp"
#include "service/pipeline/results/scan_table_sink.hpp"
#include "service/pipeline/results/trajectory_sink.hpp"
#include "service/pipeline/results/truth_report.hpp"

namespace qwsm::pipeline {

/// What a run is to leave, and under which names.
struct ResultsOptions {
  /// That for the poses as they were answered.
  ResultFile trajectory = ResultFile::kTrajectory;
  /// Whether pictures are drawn and a report is written.
  bool pictures = true;
};

/// Leaves everything a run is to leave in its folder: trajectory and table as it goes, figures and
/// pictures at the end.
class ResultsWriter final : public StepSink {
 public:
  /// Begins the results in a folder.
  /// @throws io::WriteError, as all functions of the class do.
  explicit ResultsWriter(const ResultsFolder& folder, const ResultsOptions& options = {});

  void Take(const TimedStep& timed) override;

  /// Says what was run, before Finish(): a run that is not named leaves no report.
  void SetTitle(RunTitle title) { title_ = std::move(title); }

  /// Says, before Finish(), where the map lies in the world of the truth: as the first robot in it
  /// began. Else it is as this one did.
  void SetMapInWorld(const Pose2& T_world_map) { T_world_map_ = T_world_map; }

  /// Writes what can only be known at the end. Whatever cannot be drawn is warned of.
  /// @param truth of the robot in the world; empty where it is not known.
  void Finish(const ScanMap& map,
              MatcherKind matcher,
              const OccupancyGridOptions& rendering,
              const Trajectory& truth = {});
  /// Writes what can only be known at the end of a corrected run: the corrected poses are the
  /// trajectory, and the map is that of the scans there; the map as it was goes into map_live.png.
  /// @param answered the relevant scans where they were answered.
  void Finish(std::span<const RelevantScan> answered,
              MatcherKind matcher,
              const CorrectedRun& corrected,
              const OccupancyGridOptions& rendering,
              const Trajectory& truth = {});

  /// The poses as they were answered, before Finish().
  const std::vector<io::PathPose>& path() const { return history_.path(); }
  const RunStatistics& statistics() const { return statistics_; }
  /// What the map came to that scans were matched to, after Finish().
  const MapFigures& map() const { return map_; }
  /// Counts of loops, after Finish() of a corrected run.
  const std::optional<LoopCounts>& loops() const { return loops_; }
  /// The report on the truth, after Finish(), where the truth is known.
  const std::optional<TruthReport>& truth_report() const { return truth_report_; }
  /// Where the map lies in the world of the truth: as it was set, or, after Finish(), as this robot
  /// began, where its truth is known.
  const std::optional<Pose2>& T_world_map() const { return T_world_map_; }

 private:
  // What is known at the end of a run.
  struct Outcome {
    MapFigures map;
    MatcherKind matcher;
    std::span<const io::PathPose> path;
    std::optional<LoopCounts> loops{};
  };
  // What a run and its correction are drawn from.
  struct Drawing {
    std::span<const RelevantScan> scans;
    io::MapOverlay overlay;
    const Correction* correction = nullptr;
    std::optional<OccupancyGrid> before{};  // The map before it was corrected.
  };

  void WriteFigures(const Outcome& outcome, const Trajectory& truth);
  void Draw(Drawing drawing, const OccupancyGridOptions& rendering) const;
  void WriteReport(const Drawing& drawing, const OccupancyGrid* grid) const;

  ResultsFolder folder_;
  bool has_pictures_;
  std::optional<RunTitle> title_;
  TrajectorySink trajectory_;
  ScanTableSink table_;
  RunStatistics statistics_;
  RunHistory history_;
  DoubtfulScans doubtful_;
  Json metrics_;
  std::optional<Pose2> T_world_map_;
  Trajectory truth_in_map_;
  std::optional<TruthReport> truth_report_;
  MapFigures map_;
  std::optional<LoopCounts> loops_;
};

/// The map at the wanted cell size, or, with a warning, at the smallest one that can be rendered;
/// nothing where there is nothing to render.
std::optional<OccupancyGrid> RenderOrWarn(std::span<const RelevantScan> scans,
                                          OccupancyGridOptions rendering);

}  // namespace qwsm::pipeline
