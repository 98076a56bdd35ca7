// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "qwsm/correction/self_correcting_mapper.hpp"
#include "qwsm/mapping/occupancy_painter.hpp"
#include "qwsm/mapping/relevant_scan.hpp"
#include "service/options/program_options.hpp"
#include "service/pipeline/run/interruption.hpp"
#include "service/pipeline/run/step_sink.hpp"
#include "service/team/marks/mark.hpp"
#include "service/team/scans/scan_key.hpp"

namespace qwsm::pipeline {

/// Shows a run over logs on a live page, as a service shows its robots: on a network of its own,
/// which nobody else hears.
class LiveRun final : public StepSink {
 public:
  /// Begins to serve the page. @param name of the run, for those who look.
  /// @throws view::WebError, dds::DdsError.
  LiveRun(const options::ProgramOptions& options, const std::string& name);
  ~LiveRun() override;

  /// Where the page is.
  std::string url() const;

  void Take(const TimedStep& timed) override;
  /// What has been marked on the page so far.
  std::vector<team::Mark> marks() const;
  /// Shows a correction of the map. @param scans where they are now.
  void Correct(const MapEpoch& epoch, std::span<const RelevantScan> scans);
  /// Shows that the run is over. @param scans where they are in the end.
  /// @param end in words.
  void Finish(std::span<const RelevantScan> scans, const std::string& end);
  /// Leaves the page there until the interruption.
  void StayUntil(const Interruption& interruption);

 private:
  using Clock = std::chrono::steady_clock;
  class Topics;

  team::ScanKey KeyOf(std::uint64_t relevant) const;
  void ShowAnswer(const TimedStep& timed, Clock::time_point now);
  void ShowRelevant(const TimedStep& timed);
  void ShowMap() const;
  void ShowHealth() const;

  std::string name_;
  OccupancyGridOptions rendering_;
  std::unique_ptr<Topics> topics_;
  OccupancyPainter painter_;
  bool has_new_cells_ = false;
  std::string state_ = "mapping";
  std::uint64_t scans_ = 0;
  std::uint64_t epochs_ = 0;
  std::vector<Pose2> relevant_;  // T_map_robot of relevant scans, as they were told last.
  Timestamp newest_{};
  StepStatus status_ = StepStatus::kFirst;
  Clock::time_point answer_shown_{};
  Clock::time_point scan_shown_{};
  Clock::time_point map_shown_{};
};

}  // namespace qwsm::pipeline
