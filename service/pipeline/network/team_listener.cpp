// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/team_listener.hpp"

#include <chrono>
#include <map>
#include <utility>

#include "service/dds/robot/shared_scan_reader.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ScansByKey = std::map<team::ScanKey, team::TeamScan>;

constexpr std::chrono::seconds kLongestWait = 10s;
constexpr std::chrono::seconds kLongestHearing = 60s;

}  // namespace

std::vector<team::TeamScan> HearTeamScans(const dds::Participant& participant,
                                          const std::function<bool()>& should_stop) {
  dds::SharedScanReader reader(participant);
  ScansByKey scans;
  const auto hear_until = [&](Clock::time_point end, bool is_first) {
    while (Clock::now() < end && !should_stop() && (!is_first || scans.empty())) {
      for (team::TeamScan& scan : reader.Take(100ms)) scans.try_emplace(scan.key, std::move(scan));
    }
  };
  const auto begin = Clock::now();
  hear_until(begin + kLongestWait, true);
  std::size_t before = 0;
  while (scans.size() - before > scans.size() / 10 && Clock::now() < begin + kLongestHearing) {
    before = scans.size();
    hear_until(Clock::now() + 1s, false);
    if (should_stop()) break;
  }
  if (reader.refused() > 0) messages::Warn("{} scans were refused", reader.refused());
  std::vector<team::TeamScan> sorted;
  sorted.reserve(scans.size());
  for (auto& [key, scan] : scans) sorted.push_back(std::move(scan));
  reader.Settle(sorted);
  const std::size_t apart =
      std::erase_if(sorted, [](const team::TeamScan& scan) { return !scan.component.empty(); });
  if (apart > 0) {
    messages::Warn(
        "{} scans are in maps of their robots' own, and left out: nobody knows where in "
        "the team's these lie",
        apart);
  }
  return sorted;
}

}  // namespace qwsm::pipeline
