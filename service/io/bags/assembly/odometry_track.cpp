// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/odometry_track.hpp"

#include <algorithm>
#include <tuple>

#include "service/io/logs/odometry_between.hpp"

namespace qwsm::io {

void OdometryTrack::Add(const OdometryReading& reading, std::uint64_t sequence) {
  readings_.push_back({.reading = reading, .sequence = sequence});
}

void OdometryTrack::Sort() {
  std::ranges::sort(readings_, {}, [](const Entry& entry) {
    return std::tuple(entry.reading.stamp, entry.sequence);
  });
}

std::optional<Pose2> OdometryTrack::At(Timestamp stamp, std::uint64_t sequence) const {
  const auto stamp_of = [](const Entry& entry) { return entry.reading.stamp; };
  const auto same = std::ranges::equal_range(readings_, stamp, {}, stamp_of);
  if (!same.empty()) {
    const auto later = std::ranges::lower_bound(same, sequence, {}, &Entry::sequence);
    return (later == same.begin() ? later : later - 1)->reading.T_odom_robot;
  }
  const auto after = same.begin();
  const bool has_after = after != readings_.end();
  const bool has_before = after != readings_.begin();
  if (has_after && has_before) {
    const OdometryReading& before = (after - 1)->reading;
    if (after->reading.stamp - before.stamp <= kLongestGap) {
      return Between(before, after->reading, stamp);
    }
  }
  if (has_before && stamp - (after - 1)->reading.stamp <= kLongestReach) {
    return (after - 1)->reading.T_odom_robot;
  }
  if (has_after && after->reading.stamp - stamp <= kLongestReach) {
    return after->reading.T_odom_robot;
  }
  return std::nullopt;
}

}  // namespace qwsm::io
