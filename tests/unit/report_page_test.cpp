// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/report/report_page.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "service/pipeline/report/doubtful_scans.hpp"
#include "service/pipeline/report/map_report.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

namespace fs = std::filesystem;

TEST(ReportPage, TakesNoNameForHtml) {
  const RunTitle title{.command = "qwsm map",
                       .version = "1",
                       .inputs = {"</title></script><script>alert('{{data}}')</script>"}};
  const std::string page = ReportPage(title, ReportData(title));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert('{{data}}')"), std::string::npos);
  EXPECT_NE(page.find("\\u003c/script>\\u003cscript>alert"), std::string::npos);
}

TEST(ReportPage, HasNoHoleLeft) {
  const RunTitle title{.command = "qwsm map", .version = "1", .inputs = {"a.log"}};
  EXPECT_EQ(ReportPage(title, ReportData(title)).find("{{"), std::string::npos);
}

TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(Base64(std::string_view("")), "");
  EXPECT_EQ(Base64(std::string_view("f")), "Zg==");
  EXPECT_EQ(Base64(std::string_view("fo")), "Zm8=");
  EXPECT_EQ(Base64(std::string_view("foobar")), "Zm9vYmFy");
  const std::array one{1.0F};
  EXPECT_EQ(Base64(std::span<const float>(one)), "AACAPw==");
}

TEST(MapReport, HoldsOfLongRunsTheWorstOfNeighbours) {
  constexpr std::size_t kScans = 2 * kMostRows + 1;
  io::MapOverlay overlay{.path = std::vector<io::PathPose>(kScans), .truth = {}, .odometry = {}};
  std::vector<double> residuals_mm(kScans, 1.0);
  residuals_mm[40'001] = 50.0;
  const std::vector<double> times_ms(kScans, 0.1);
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "report.html";
  WriteMapReport(file,
                 {.command = "qwsm map", .version = "1", .inputs = {}},
                 {.metrics = {},
                  .overlay = overlay,
                  .residuals_mm = residuals_mm,
                  .times_ms = times_ms,
                  .doubtful = {},
                  .relevant = {}});
  const std::string page = test::ReadFile(file);
  EXPECT_NE(page.find("\"stride\":3"), std::string::npos);
  std::vector<float> numbers;
  for (std::size_t row = 0; 3 * row < kScans; ++row) {
    numbers.push_back(row == 13'333 ? 40'001.0F : static_cast<float>(3 * row));
  }
  EXPECT_NE(page.find(Base64(std::span<const float>(numbers))), std::string::npos);
  EXPECT_LT(page.size(), 3'000'000U);
}

/// The mapper's answer to a scan, as far as it counts here.
TimedStep StepWith(StepStatus status, double residual_m, const LaserScan& scan) {
  TimedStep timed{.step = {}, .scan = &scan};
  timed.step.status = status;
  timed.step.match.mean_residual_m = residual_m;
  return timed;
}

TEST(DoubtfulScans, PutsWhatWasNotMatchedFirst) {
  const LaserScan scan;
  DoubtfulScans doubtful;
  for (int i = 0; i < 200; ++i) {
    const bool is_dead_reckoned = i == 50;
    const double residual_m = i == 100 ? 0.5 : 0.01;
    doubtful.Take(StepWith(is_dead_reckoned ? StepStatus::kDeadReckoned : StepStatus::kMatched,
                           is_dead_reckoned ? 0.001 : residual_m,
                           scan));
  }
  const std::vector<DoubtfulScan> worst = doubtful.Worst();
  ASSERT_GE(worst.size(), 2U);
  EXPECT_EQ(worst[0].number, 50U);
  EXPECT_EQ(worst[1].number, 100U);
}

TEST(DoubtfulScans, KeepsFewAndOfNeighboursTheWorst) {
  const LaserScan scan;
  DoubtfulScans doubtful;
  for (int i = 0; i < 10'000; ++i) {
    doubtful.Take(StepWith(StepStatus::kMatched, 1e-6 * (i % 700), scan));
  }
  const std::vector<DoubtfulScan> worst = doubtful.Worst();
  EXPECT_EQ(worst.size(), DoubtfulScans::kMost);
  for (const DoubtfulScan& one : worst) EXPECT_EQ(one.number % 700, 699U) << one.number;
}

TEST(DoubtfulScans, LeavesOutWhoseReadingsAreGone) {
  const LaserScan scan;
  DoubtfulScans doubtful;
  TimedStep timed = StepWith(StepStatus::kDeadReckoned, 0.1, scan);
  timed.scan = nullptr;
  doubtful.Take(timed);
  EXPECT_TRUE(doubtful.Worst().empty());
}

}  // namespace
}  // namespace qwsm::pipeline
