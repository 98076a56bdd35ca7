// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "qwsm/geometry/angle.hpp"
#include "service/config/text_table.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::pipeline {
namespace {

std::string Milliseconds(std::chrono::nanoseconds duration) {
  return fmt::format("{:.2f}", 1e3 * Seconds(duration));
}

}  // namespace

void TeamTable::Take(const dds::MatchReport& report, Clock::time_point now) {
  Robot& robot = robots_[report.robot];
  robot.last = report;
  robot.recent.push_back({.at = now, .latency = report.latency});
  while (now - robot.recent.front().at > kWindow) robot.recent.pop_front();
}

std::string TeamTable::Text(Clock::time_point now) const {
  std::vector<std::vector<std::string>> rows{{"robot",
                                              "x m",
                                              "y m",
                                              "deg",
                                              "+- mm",
                                              "+- deg",
                                              "status",
                                              "overlap %",
                                              "scans/s",
                                              "latency ms",
                                              "longest",
                                              "dropped"}};
  for (const auto& [name, robot] : robots_) rows.push_back(RowOf(robot, now));
  return config::FormatTable(rows);
}

std::vector<std::string> TeamTable::RowOf(const Robot& robot, Clock::time_point now) {
  const dds::MatchReport& last = robot.last;
  const Pose2& pose = last.map_robot.T_a_b;
  const Eigen::Matrix3d& covariance = last.map_robot.covariance;
  const bool is_silent = now - robot.recent.back().at > kSilence;
  std::vector<std::chrono::nanoseconds> latencies;
  for (const Heard& heard : robot.recent) latencies.push_back(heard.latency);
  std::ranges::sort(latencies);
  const double heard_for_s =
      std::max(1.0, Seconds(robot.recent.back().at - robot.recent.front().at));
  return {team::DisplayName(last.robot),
          fmt::format("{:.2f}", pose.x_m),
          fmt::format("{:.2f}", pose.y_m),
          fmt::format("{:.1f}", RadiansToDegrees(pose.theta_rad)),
          fmt::format("{:.0f}", 1e3 * std::sqrt(covariance(0, 0) + covariance(1, 1))),
          fmt::format("{:.2f}", RadiansToDegrees(std::sqrt(covariance(2, 2)))),
          is_silent ? fmt::format("silent for {:.0f} s", Seconds(now - robot.recent.back().at))
                    : std::string(Name(last.status)),
          fmt::format("{:.0f}", 100.0 * last.overlap),
          fmt::format("{:.1f}", static_cast<double>(latencies.size() - 1) / heard_for_s),
          Milliseconds(latencies[latencies.size() / 2]),
          Milliseconds(latencies.back()),
          fmt::format("{}", last.dropped)};
}

}  // namespace qwsm::pipeline
