// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "qwsm/correction/map_corrector.hpp"
#include "service/io/pictures/trajectory_picture.hpp"
#include "service/pipeline/results/results_folder.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Counts the loops that came to each end.
struct LoopCounts {
  std::size_t accepted = 0;
  std::size_t found = 0;
};
LoopCounts CountLoops(const std::vector<Loop>& loops);

/// What is left of a run once its map is corrected.
struct CorrectedRun {
  Correction correction;
  ScanMap map;  ///< The scans at their corrected poses.
};

/// Listens to a run, and corrects it in the end.
class CorrectionSink final : public StepSink {
 public:
  explicit CorrectionSink(const MapperOptions& options) : corrector_(options) {}

  void Take(const TimedStep& timed) override;
  /// Corrects a run. @param map that the run made.
  CorrectedRun Correct(const ScanMap& map) const;

 private:
  MapCorrector corrector_;
};

/// Writes loops.csv, a line per loop that was found, and the graph as graph.g2o and
/// graph.toro.
/// @throws io::WriteError.
void WriteLoops(const ResultsFolder& folder, const Correction& correction, const ScanMap& map);

/// The loops of a correction as lines between the places that they join.
std::vector<io::LoopLine> LoopLines(const Correction& correction);

}  // namespace qwsm::pipeline
