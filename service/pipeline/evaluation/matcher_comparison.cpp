// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/matcher_comparison.hpp"

#include <cassert>
#include <limits>

#include "service/pipeline/results/scan_table_sink.hpp"

namespace qwsm::pipeline {
namespace {

/// One figure of two matchers, over the scans.
struct FigurePair {
  double candidate_sum = 0.0;
  double baseline_sum = 0.0;
  std::size_t smaller = 0;

  void Add(double candidate, double baseline) {
    candidate_sum += candidate;
    baseline_sum += baseline;
    if (candidate < baseline) ++smaller;
  }
};

/// NaN where there is nothing to divide by.
double Ratio(double a, double b) {
  return b > 0.0 ? a / b : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void FiguresSink::Take(const TimedStep& timed) {
  scans_.push_back(
      {.stamp = timed.step.stamp,
       .status = timed.step.status,
       .residual_mm = timed.step.match.mean_residual_m * 1e3,
       .trace_m2 = PositionTrace_m2(timed.step.match),
       .duration_ms = std::chrono::duration<double, std::milli>(timed.worked).count()});
}

std::vector<double> FiguresSink::Residuals_mm() const {
  std::vector<double> residuals_mm;
  residuals_mm.reserve(scans_.size());
  for (const ScanFigures& scan : scans_) {
    residuals_mm.push_back(HasMatch(scan.status) ? scan.residual_mm
                                                 : std::numeric_limits<double>::quiet_NaN());
  }
  return residuals_mm;
}

MatcherComparison CompareMatchers(std::span<const ScanFigures> candidate,
                                  std::span<const ScanFigures> baseline) {
  assert(candidate.size() == baseline.size() && "figures of the same scans");
  FigurePair residual;
  FigurePair trace;
  MatcherComparison comparison;
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    if (!HasMatch(candidate[i].status) || !HasMatch(baseline[i].status)) continue;
    ++comparison.scans;
    residual.Add(candidate[i].residual_mm, baseline[i].residual_mm);
    trace.Add(candidate[i].trace_m2, baseline[i].trace_m2);
  }
  const auto scans = static_cast<double>(comparison.scans);
  comparison.residual_ratio = Ratio(residual.candidate_sum, residual.baseline_sum);
  comparison.trace_ratio = Ratio(trace.candidate_sum, trace.baseline_sum);
  comparison.smaller_residual_share = Ratio(static_cast<double>(residual.smaller), scans);
  comparison.smaller_trace_share = Ratio(static_cast<double>(trace.smaller), scans);
  return comparison;
}

}  // namespace qwsm::pipeline
