// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/gyro_track.hpp"

#include <algorithm>
#include <chrono>

namespace qwsm {
namespace {

// A gyro that is silent for longer has missed turns.
constexpr std::chrono::nanoseconds kLongestSilence = std::chrono::milliseconds(200);

}  // namespace

bool GyroTrack::Add(const ImuReading& reading) {
  const double rate_rad_s = reading.turn_rate_rad_s.z();
  if (!readings_.empty()) {
    const Turn& before = readings_.back();
    if (reading.stamp <= before.stamp) return false;
    turned_rad_ += 0.5 * (before.rate_rad_s + rate_rad_s) * Seconds(reading.stamp - before.stamp);
  }
  readings_.push_back(
      {.stamp = reading.stamp, .rate_rad_s = rate_rad_s, .turned_rad = turned_rad_});
  if (capacity_ != kUnlimited && readings_.size() > capacity_) readings_.pop_front();
  return true;
}

bool GyroTrack::Covers(Timestamp stamp) const {
  return !readings_.empty() && readings_.back().stamp >= stamp;
}

std::optional<double> GyroTrack::At(Timestamp stamp) const {
  const auto after = std::ranges::lower_bound(readings_, stamp, {}, &Turn::stamp);
  if (after == readings_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->turned_rad;
  if (after == readings_.begin()) return std::nullopt;
  const Turn& before = *(after - 1);
  if (after->stamp - before.stamp > kLongestSilence) return std::nullopt;
  const double share = Seconds(stamp - before.stamp) / Seconds(after->stamp - before.stamp);
  return before.turned_rad + share * (after->turned_rad - before.turned_rad);
}

}  // namespace qwsm
