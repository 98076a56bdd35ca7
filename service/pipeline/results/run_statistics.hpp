// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/pipeline/run/step_sink.hpp"
#include "service/pipeline/run/thinned_series.hpp"

namespace qwsm::pipeline {

/// Adds up what a run was like. Times are processor times.
class RunStatistics final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  std::size_t scans() const;
  std::size_t relevant() const { return relevant_; }
  std::size_t Count(StepStatus status) const;
  double path_length_m() const { return path_length_m_; }
  /// Scans since the robot was lost, where it was not found again.
  std::size_t lost_at_end() const { return lost_at_end_; }
  /// Mean residual over the matched scans, in mm; 0 where there is none.
  double MeanResidual_mm() const;
  double MeanTrace_m2() const;
  double total_time_s() const { return 1e-3 * time_sum_ms_; }
  /// Time from the first scan to the last, by their stamps.
  double drive_time_s() const { return Seconds(last_ - first_); }
  /// Whether a robot would have outrun the mapping.
  bool is_outrun() const { return drive_time_s() > 0.0 && total_time_s() > drive_time_s(); }
  /// Quantile of the time per scan: 0.5 is the median. @pre scans() > 0.
  double TimeQuantile_ms(double quantile) const;
  double longest_time_ms() const { return longest_time_ms_; }

 private:
  static constexpr std::size_t kMostDurations = 1'000'000;

  ThinnedSeries<double> durations_ms_{kMostDurations};
  double time_sum_ms_ = 0.0;
  double longest_time_ms_ = 0.0;
  std::vector<std::size_t> count_of_status_ = std::vector<std::size_t>(5);
  std::size_t relevant_ = 0;
  std::size_t lost_at_end_ = 0;
  double path_length_m_ = 0.0;
  double residual_sum_mm_ = 0.0;
  double trace_sum_m2_ = 0.0;
  std::optional<Pose2> T_map_last_;
  Timestamp first_{};
  Timestamp last_{};
};

}  // namespace qwsm::pipeline
