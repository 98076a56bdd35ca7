// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The table of what the mapper found out about every scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "service/pipeline/results/scan_table_sink.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::pipeline {
namespace {

std::vector<std::string> RowsOf(const std::filesystem::path& file) {
  std::ifstream text(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

TEST(ScanTable, HasEmptyColumnsWhereTheCorrectedMapHasNoPlace) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scans.csv";
  ScanTableSink table(file);
  for (const double x_m : {1.0, 2.0}) {
    MappingStep step;
    step.map_robot.T_a_b = {x_m, 0.0, 0.0};
    table.Take({.step = step});
  }
  table.Commit();
  const std::vector<std::string> before = RowsOf(file);
  AddCorrectedPoses(file,
                    std::vector{std::optional(UncertainPose2{.T_a_b = {1.5, 0.0, 0.0}}),
                                std::optional<UncertainPose2>()});
  const std::vector<std::string> after = RowsOf(file);
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[1], before[1] + ",1.5,0,0,0,0,0,0,0,0");
  EXPECT_EQ(after[2], before[2] + ",,,,,,,,,");
  for (const std::string& line : after) {
    EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(after[0], ','));
  }
}

}  // namespace
}  // namespace qwsm::pipeline
