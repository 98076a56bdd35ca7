// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/assembly/gyro_track.hpp"

#include <algorithm>
#include <chrono>

namespace qwsm::io {
namespace {

// A gyro that is silent for longer has missed turns.
constexpr std::chrono::nanoseconds kLongestSilence = std::chrono::milliseconds(200);

double SecondsOf(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

void GyroTrack::Add(Timestamp stamp, const std::array<double, 3>& turn_rate_rad_s) {
  readings_.push_back({.stamp = stamp, .turn_rate_rad_s = turn_rate_rad_s});
}

void GyroTrack::Integrate(const Quaternion& q) {
  std::ranges::stable_sort(readings_, {}, &Reading::stamp);
  // The lowest row of the rotation's matrix.
  const std::array<double, 3> up{2.0 * (q.x * q.z - q.y * q.w),
                                 2.0 * (q.y * q.z + q.x * q.w),
                                 1.0 - 2.0 * (q.x * q.x + q.y * q.y)};
  const auto yaw_rate = [&](const Reading& reading) {
    const std::array<double, 3>& rate = reading.turn_rate_rad_s;
    return up[0] * rate[0] + up[1] * rate[1] + up[2] * rate[2];
  };
  for (std::size_t i = 1; i < readings_.size(); ++i) {
    const Reading& before = readings_[i - 1];
    readings_[i].turned_rad = before.turned_rad + 0.5 *
                                                      (yaw_rate(before) + yaw_rate(readings_[i])) *
                                                      SecondsOf(readings_[i].stamp - before.stamp);
  }
}

std::optional<double> GyroTrack::At(Timestamp stamp) const {
  const auto after = std::ranges::lower_bound(readings_, stamp, {}, &Reading::stamp);
  if (after == readings_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->turned_rad;
  if (after == readings_.begin()) return std::nullopt;
  const Reading& before = *(after - 1);
  if (after->stamp - before.stamp > kLongestSilence) return std::nullopt;
  const double share = SecondsOf(stamp - before.stamp) / SecondsOf(after->stamp - before.stamp);
  return before.turned_rad + share * (after->turned_rad - before.turned_rad);
}

}  // namespace qwsm::io
