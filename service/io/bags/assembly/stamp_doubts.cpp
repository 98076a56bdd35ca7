// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/stamp_doubts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace qwsm::io {
namespace {

// Messages of one topic are recorded out of order by less than that.
constexpr Timestamp kLeastFall = std::chrono::seconds(1);
// Of so many scans one may be without odometry: as a recording begins and ends.
constexpr std::ptrdiff_t kScansWithOdometry = 10;

std::string SecondsText(Timestamp time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", Seconds(time));
  return text.data();
}

}  // namespace

void DoubtStampsThatFallBack(const std::string& topic,
                             std::span<const MessagePlace> places,
                             BagFaults& faults) {
  const auto falls = [](const MessagePlace& before, const MessagePlace& after) {
    return before.stamp - after.stamp > kLeastFall;
  };
  const auto first = std::ranges::adjacent_find(places, falls);
  if (first == places.end()) return;
  std::size_t more = 0;
  for (auto next = first + 1; next + 1 != places.end(); ++next) more += falls(*next, *(next + 1));
  const MessagePlace& after = *(first + 1);
  faults.Doubt(
      "stamps of " + topic + " fall back by " + SecondsText(first->stamp - after.stamp) +
      " at message " + std::to_string(after.sequence) +
      (more > 0 ? ", and " + std::to_string(more) + " times more" : "") +
      ": scans are read by their stamps, which mixes two drives if a simulator began anew there, "
      "or another recording; map each by itself");
}

void DoubtScansWithoutOdometry(std::span<const MessagePlace> scans,
                               const OdometryTrack& odometry,
                               BagFaults& faults) {
  if (scans.empty() || odometry.empty()) return;
  const auto without = std::ranges::count_if(
      scans, [&](const MessagePlace& scan) { return !odometry.At(scan.stamp, scan.sequence); });
  if (without * kScansWithOdometry <= std::ssize(scans)) return;
  const auto span = [](Timestamp first, Timestamp last) {
    return "from " + SecondsText(first) + " to " + SecondsText(last);
  };
  faults.Doubt(std::to_string(without) + " of " + std::to_string(scans.size()) +
               " scans have no odometry within reach: scans are " +
               span(scans.front().stamp, scans.back().stamp) + ", odometry " +
               span(odometry.reading(0).stamp, odometry.reading(odometry.size() - 1).stamp));
}

}  // namespace qwsm::io
