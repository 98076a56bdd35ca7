// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/evaluation/matcher_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qwsm::pipeline {
namespace {

ScanFigures Matched(double residual_mm, double trace_m2) {
  return {.status = StepStatus::kMatched, .residual_mm = residual_mm, .trace_m2 = trace_m2};
}

ScanFigures Failed() { return {.status = StepStatus::kDeadReckoned, .residual_mm = 1e6}; }

TEST(CompareMatchers, DividesMeansAndCountsScans) {
  const std::vector<ScanFigures> candidate{Matched(1.0, 0.1), Matched(2.0, 0.5), Matched(3.0, 0.2)};
  const std::vector<ScanFigures> baseline{Matched(4.0, 0.2), Matched(4.0, 0.4), Matched(4.0, 1.0)};
  const MatcherComparison comparison = CompareMatchers(candidate, baseline);
  EXPECT_EQ(comparison.scans, 3U);
  EXPECT_DOUBLE_EQ(comparison.residual_ratio, 0.5);
  EXPECT_DOUBLE_EQ(comparison.trace_ratio, 0.5);
  EXPECT_DOUBLE_EQ(comparison.smaller_residual_share, 1.0);
  EXPECT_DOUBLE_EQ(comparison.smaller_trace_share, 2.0 / 3.0);
}

TEST(CompareMatchers, PassesOverScansThatOneOfThemFailedOn) {
  const std::vector<ScanFigures> candidate{{}, Matched(1.0, 0.1), Failed(), Matched(1.0, 0.1)};
  const std::vector<ScanFigures> baseline{{}, Failed(), Matched(2.0, 0.2), Matched(4.0, 0.2)};
  const MatcherComparison comparison = CompareMatchers(candidate, baseline);
  EXPECT_EQ(comparison.scans, 1U);
  EXPECT_DOUBLE_EQ(comparison.residual_ratio, 0.25);
}

TEST(CompareMatchers, SaysNothingOfNoScans) {
  const std::vector<ScanFigures> candidate{Failed()};
  const std::vector<ScanFigures> baseline{Matched(2.0, 0.2)};
  const MatcherComparison comparison = CompareMatchers(candidate, baseline);
  EXPECT_EQ(comparison.scans, 0U);
  EXPECT_TRUE(std::isnan(comparison.residual_ratio));
  EXPECT_TRUE(std::isnan(comparison.smaller_trace_share));
}

}  // namespace
}  // namespace qwsm::pipeline
