// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/odometry_track.hpp"

#include <algorithm>
#include <utility>

#include "service/io/logs/odometry_between.hpp"

namespace qwsm::io {

void OdometryTrack::Add(const OdometryReading& reading, std::uint64_t sequence) {
  readings_.push_back({.reading = reading, .sequence = sequence});
}

void OdometryTrack::Sort() { std::ranges::sort(readings_, {}, OrderOf); }

std::optional<Pose2> OdometryTrack::At(Timestamp stamp, std::uint64_t sequence) const {
  const auto after = std::ranges::lower_bound(readings_, std::pair(stamp, sequence), {}, OrderOf);
  if (after != readings_.begin() && (after - 1)->reading.stamp == stamp) {
    return (after - 1)->reading.T_odom_robot;
  }
  if (after != readings_.end() && after->reading.stamp == stamp) return after->reading.T_odom_robot;
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
