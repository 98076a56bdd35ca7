// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// The figures by which a matcher's answer to one scan is compared.
struct ScanFigures {
  Timestamp stamp{};
  StepStatus status = StepStatus::kFirst;
  double residual_mm = 0.0;  ///< Mean distance that is left between the points of a pair.
  double trace_m2 = 0.0;     ///< PositionTrace_m2() of the match.
  double duration_ms = 0.0;
};

/// Keeps the figures of a run, scan by scan.
class FiguresSink final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  const std::vector<ScanFigures>& scans() const { return scans_; }
  /// The residual of each scan, in mm; NaN where there was no match.
  std::vector<double> Residuals_mm() const;

 private:
  std::vector<ScanFigures> scans_;
};

/// How one matcher fares beside another, as in section 4.1 of Visser et al. (2009): over the scans
/// that both matched, mean against mean and scan by scan. NaN where there is no such scan.
struct MatcherComparison {
  std::size_t scans = 0;  ///< Scans matched by both.
  double residual_ratio = 0.0;
  double trace_ratio = 0.0;
  /// Share of the scans in which the first one's residual is smaller.
  double smaller_residual_share = 0.0;
  double smaller_trace_share = 0.0;
};

/// Compares two matchers. @pre figures of the same scans, one for one.
MatcherComparison CompareMatchers(std::span<const ScanFigures> candidate,
                                  std::span<const ScanFigures> baseline);

}  // namespace qwsm::pipeline
