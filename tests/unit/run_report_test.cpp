// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/run_report.hpp"

#include <gtest/gtest.h>

#include <string>

namespace qwsm::pipeline {
namespace {

using namespace std::chrono_literals;

/// What is said of three scans, a tenth of a second apart, that took so long each.
std::string SummaryOf(std::chrono::milliseconds each) {
  RunStatistics run;
  for (int scan = 0; scan < 3; ++scan) {
    TimedStep timed;
    timed.step.stamp = scan * 100ms;
    timed.worked = each;
    timed.duration = 10 * each;  // The machine had other work.
    run.Take(timed);
  }
  return SummaryText(run, MapFigures(), std::nullopt);
}

TEST(RunReport, SaysWhenMappingIsSlowerThanTheRobotDrove) {
  const std::string told = "too slow       0.6 s of work for 0.2 s of driving\n";
  EXPECT_NE(SummaryOf(200ms).find(told), std::string::npos) << SummaryOf(200ms);
  EXPECT_EQ(SummaryOf(20ms).find("too slow"), std::string::npos) << SummaryOf(20ms);
}

TEST(RunReport, SaysWhetherALostRobotWasFoundAgain) {
  RunStatistics run;
  const auto take = [&run](StepStatus status) {
    TimedStep timed;
    timed.step.status = status;
    run.Take(timed);
  };
  take(StepStatus::kLost);
  take(StepStatus::kMatched);
  const std::string found = SummaryText(run, MapFigures(), std::nullopt);
  EXPECT_NE(found.find("lost           1, and placed once"), std::string::npos) << found;
  take(StepStatus::kLost);
  take(StepStatus::kLost);
  const std::string lost = SummaryText(run, MapFigures(), std::nullopt);
  EXPECT_NE(lost.find("lost           3, of which the last 2 are"), std::string::npos) << lost;
}

}  // namespace
}  // namespace qwsm::pipeline
