// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "service/dds/wire/match_report.hpp"

namespace qwsm::pipeline {

/// The robots of a team at a glance: a row for each, from what services report on them.
class TeamTable {
 public:
  using Clock = std::chrono::steady_clock;
  /// Rates and latencies are taken over the reports of so long.
  static constexpr std::chrono::nanoseconds kWindow = std::chrono::seconds(5);
  /// A robot that was not heard of for so long is silent.
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::seconds(2);

  void Take(const dds::MatchReport& report, Clock::time_point now);

  bool empty() const { return robots_.empty(); }
  /// Where each robot is, how sure that is, what became of its last scan, how many are answered a
  /// second and how quickly, and how many were dropped so far. Lines end with a newline.
  std::string Text(Clock::time_point now) const;

 private:
  struct Heard {
    Clock::time_point at{};
    std::chrono::nanoseconds latency{};
  };
  struct Robot {
    dds::MatchReport last;
    std::deque<Heard> recent;  // Reports of the window, as of the last one.
  };

  static std::vector<std::string> RowOf(const Robot& robot, Clock::time_point now);

  std::map<std::string, Robot> robots_;
};

}  // namespace qwsm::pipeline
