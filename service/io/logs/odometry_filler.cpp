// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/odometry_filler.hpp"

#include <utility>

#include "service/io/logs/odometry_between.hpp"

namespace qwsm::io {
namespace {

constexpr std::size_t kKeptOdometry = 256;
constexpr std::size_t kMaxHeldRecords = 256;
constexpr std::size_t kMaxHeldReadings = 1'000'000;

std::size_t ReadingsOf(const LogRecord& record) {
  const auto* scan = std::get_if<ScanReading>(&record);
  return scan == nullptr ? 0 : scan->scan.size();
}

}  // namespace

void OdometryFiller::Push(LogRecord record) {
  if (const auto* reading = std::get_if<OdometryReading>(&record)) {
    odometry_.push_back(*reading);
    if (odometry_.size() > kKeptOdometry) odometry_.pop_front();
  }
  held_readings_ += ReadingsOf(record);
  held_.push_back(std::move(record));
}

void OdometryFiller::Finish() { finished_ = true; }

std::optional<LogRecord> OdometryFiller::Take() {
  if (held_.empty()) return std::nullopt;
  if (auto* scan = std::get_if<ScanReading>(&held_.front()); scan && !scan->T_odom_robot) {
    if (MustWait(scan->scan.stamp)) return std::nullopt;
    scan->T_odom_robot = Interpolate(scan->scan.stamp);
  }
  LogRecord record = std::move(held_.front());
  held_.pop_front();
  held_readings_ -= ReadingsOf(record);
  return record;
}

/// Whether an odometry reading from after `stamp` may still come.
bool OdometryFiller::MustWait(Timestamp stamp) const {
  if (finished_) return false;
  if (held_.size() > kMaxHeldRecords || held_readings_ > kMaxHeldReadings) return false;
  return odometry_.empty() || odometry_.back().stamp < stamp;
}

std::optional<Pose2> OdometryFiller::Interpolate(Timestamp stamp) const {
  const OdometryReading* before = nullptr;
  const OdometryReading* after = nullptr;
  for (const OdometryReading& reading : odometry_) {  // Stamps may step back: look at all.
    if (reading.stamp <= stamp && (!before || reading.stamp >= before->stamp)) before = &reading;
    if (reading.stamp >= stamp && (!after || reading.stamp < after->stamp)) after = &reading;
  }
  if (before && after && after->stamp - before->stamp <= kLongestGap) {
    return Between(*before, *after, stamp);
  }
  if (before && stamp - before->stamp <= kLongestReach) return before->T_odom_robot;
  if (after && after->stamp - stamp <= kLongestReach) return after->T_odom_robot;
  return std::nullopt;
}

}  // namespace qwsm::io
