// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "service/pipeline/step_sink.hpp"

namespace qwsm::pipeline {

/// Adds up what a run was like.
class RunStatistics final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  std::size_t scans() const { return durations_ms_.size(); }
  std::size_t relevant() const { return relevant_; }
  std::size_t Count(StepStatus status) const;
  double path_length_m() const { return path_length_m_; }
  /// Over the matched scans; 0 for none.
  double MeanResidual_mm() const;
  double MeanTrace_m2() const;
  double TotalTime_s() const;
  /// Of the time per scan: 0.5 is the median. @pre scans() > 0.
  double TimeQuantile_ms(double quantile) const;

 private:
  std::vector<double> durations_ms_;
  std::vector<std::size_t> count_of_status_ = std::vector<std::size_t>(4);
  std::size_t relevant_ = 0;
  double path_length_m_ = 0.0;
  double residual_sum_mm_ = 0.0;
  double trace_sum_m2_ = 0.0;
  std::optional<Pose2> T_map_last_;
};

}  // namespace qwsm::pipeline
