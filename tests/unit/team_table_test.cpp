// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_table.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace qwsm::pipeline {
namespace {

using namespace std::chrono_literals;

dds::MatchReport Report(const std::string& robot, std::chrono::nanoseconds latency) {
  dds::MatchReport report;
  report.robot = robot;
  report.map_robot.T_a_b = {1.0, -2.0, 0.0};
  report.status = StepStatus::kMatched;
  report.map_robot.covariance.diagonal() << 9e-6, 16e-6, 0.0;
  report.overlap = 0.5;
  report.latency = latency;
  report.dropped = 3;
  return report;
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(TeamTable, HasARowForEachRobotInTheOrderOfTheirNames) {
  TeamTable table;
  EXPECT_TRUE(table.empty());
  const TeamTable::Clock::time_point begin{};
  table.Take(Report("robot2", 1ms), begin);
  table.Take(Report("robot1", 1ms), begin);
  table.Take(Report("", 1ms), begin);
  const std::vector<std::string> lines = LinesOf(table.Text(begin));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_TRUE(lines[0].starts_with("robot "));
  EXPECT_TRUE(lines[1].starts_with("robot "));  // Has no namespace.
  EXPECT_TRUE(lines[2].starts_with("robot1"));
  EXPECT_TRUE(lines[3].starts_with("robot2"));
}

TEST(TeamTable, SaysHowSureHowOftenAndHowQuickly) {
  TeamTable table;
  TeamTable::Clock::time_point now{};
  table.Take(Report("robot1", 900ms), now);  // Long ago: not in the window.
  now += 20s;
  for (int i = 0; i <= 20; ++i) {
    table.Take(Report("robot1", i == 7 ? 8ms : 2ms), now);
    if (i < 20) now += 100ms;
  }
  std::istringstream row(LinesOf(table.Text(now)).at(1));
  const std::vector<std::string> cells{std::istream_iterator<std::string>(row), {}};
  EXPECT_EQ(cells,
            (std::vector<std::string>{"robot1",
                                      "1.00",
                                      "-2.00",
                                      "0.0",
                                      "5",
                                      "0.00",
                                      "matched",
                                      "50",
                                      "10.0",
                                      "2.00",
                                      "8.00",
                                      "3"}));
}

TEST(TeamTable, SaysWhoIsSilent) {
  TeamTable table;
  table.Take(Report("robot1", 1ms), TeamTable::Clock::time_point{});
  EXPECT_EQ(table.Text(TeamTable::Clock::time_point{1s}).find("silent"), std::string::npos);
  EXPECT_NE(table.Text(TeamTable::Clock::time_point{7s}).find("silent for 7 s"), std::string::npos);
}

}  // namespace
}  // namespace qwsm::pipeline
