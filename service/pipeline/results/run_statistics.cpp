// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/run_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "service/pipeline/results/scan_table_sink.hpp"

namespace qwsm::pipeline {

void RunStatistics::Take(const TimedStep& timed) {
  const MappingStep& step = timed.step;
  const double time_ms = std::chrono::duration<double, std::milli>(timed.worked).count();
  if (scans() == 0) first_ = step.stamp;
  last_ = step.stamp;
  durations_ms_.Add(time_ms);
  time_sum_ms_ += time_ms;
  longest_time_ms_ = std::max(longest_time_ms_, time_ms);
  ++count_of_status_[static_cast<std::size_t>(step.status)];
  lost_at_end_ = step.status == StepStatus::kLost ? lost_at_end_ + 1 : 0;
  if (step.relevant) ++relevant_;
  if (HasMatch(step.status)) {
    residual_sum_mm_ += step.match.mean_residual_m * 1e3;
    trace_sum_m2_ += PositionTrace_m2(step.match);
  }
  const Pose2& T_map_robot = step.map_robot.T_a_b;
  if (T_map_last_) {
    path_length_m_ += (T_map_robot.translation_m() - T_map_last_->translation_m()).norm();
  }
  T_map_last_ = T_map_robot;
}

std::size_t RunStatistics::scans() const {
  return std::accumulate(count_of_status_.begin(), count_of_status_.end(), std::size_t{0});
}

std::size_t RunStatistics::Count(StepStatus status) const {
  return count_of_status_[static_cast<std::size_t>(status)];
}

double RunStatistics::MeanResidual_mm() const {
  const std::size_t matches = Count(StepStatus::kMatched) + Count(StepStatus::kExtended);
  return matches == 0 ? 0.0 : residual_sum_mm_ / static_cast<double>(matches);
}

double RunStatistics::MeanTrace_m2() const {
  const std::size_t matches = Count(StepStatus::kMatched) + Count(StepStatus::kExtended);
  return matches == 0 ? 0.0 : trace_sum_m2_ / static_cast<double>(matches);
}

double RunStatistics::TimeQuantile_ms(double quantile) const {
  assert(scans() > 0 && "no scan, no time per scan");
  std::vector<double> sorted = durations_ms_.elements();
  const auto last = static_cast<double>(sorted.size() - 1);
  const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(std::llround(quantile * last));
  std::ranges::nth_element(sorted, nth);
  return *nth;
}

}  // namespace qwsm::pipeline
