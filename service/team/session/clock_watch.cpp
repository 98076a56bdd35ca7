// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/clock_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {
namespace {

constexpr const char* kMending =
    "whoever publishes both has to stamp them by one clock, and without a break";

// Told with the last scan of so many in a row.
bool IsTold(bool is_apart, int& scans) {
  scans = is_apart ? scans + 1 : 0;
  return scans == ClockWatch::kScans;
}

}  // namespace

std::string ClockWatch::NoteOdometry(std::chrono::nanoseconds apart) {
  if (!IsTold(apart > kApart || apart < -kApart, without_odometry_)) return {};
  return fmt::format(
      "its scans are matched without odometry, which is of another time: they are stamped {:.1f} s "
      "{}; {}",
      std::abs(Seconds(apart)),
      apart.count() > 0 ? "after the newest of it" : "before the oldest that is kept",
      kMending);
}

std::string ClockWatch::NoteGyro(bool is_apart) {
  if (!IsTold(is_apart, without_gyro_)) return {};
  return fmt::format(
      "its scans are matched without its gyro, whose readings are of another time; {}", kMending);
}

}  // namespace qwsm::team
