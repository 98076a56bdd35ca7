// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/sweep_completer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "service/io/logs/sweep_geometry.hpp"

namespace qwsm::io {
namespace {

// A Player log may come from many devices; a damaged one from any number.
constexpr std::size_t kMaxLasers = 64;

/// The same sweep often stands in two messages: raw as the driver gave it, and with the robot's
/// pose. What tells more is better.
int Rank(std::string_view message) {
  if (message.starts_with("ROBOTLASER")) return 2;
  return message == "FLASER" || message == "RLASER" ? 1 : 0;
}

int Rank(const std::string& laser) { return laser == "front" ? 0 : laser == "rear" ? 1 : 2; }

}  // namespace

void SweepCompleter::Observe(const Sweep& sweep, const std::optional<Pose2>& T_odom_robot) {
  auto found = lasers_.find(sweep.reading.laser);
  if (found == lasers_.end()) {
    if (lasers_.size() >= kMaxLasers) return;
    found = lasers_.try_emplace(sweep.reading.laser).first;
  }
  Laser& laser = found->second;
  ++laser.sweeps[sweep.message];
  ++laser.observed;
  laser.mounting_known = laser.mounting_known || sweep.mounting_known;
  const std::optional<Pose2>& T_sweep = sweep.reading.T_odom_robot;
  laser.range_maximum.Add(sweep.reading.scan.ranges_m, T_sweep ? T_sweep : T_odom_robot);
  const bool open = !decided_ && !sweep.mounting_known;
  if (open && T_sweep && sweep.T_odom_laser) laser.mounting.Add(*T_sweep, *sweep.T_odom_laser);
  if (decided_ && laser.observed >= laser.next_estimate) {
    if (front_.empty()) front_ = sweep.reading.laser;  // There were no sweeps to decide from.
    if (!laser.decided) Choose(sweep.reading.laser, laser);
    laser.range_max_m = laser.range_maximum.Estimate();
    laser.next_estimate = 2 * laser.observed;
  }
}

void SweepCompleter::Decide() {
  decided_ = true;
  for (const auto& [name, laser] : lasers_) {
    if (front_.empty() || Rank(name) < Rank(front_)) front_ = name;
  }
  bool any = false;
  for (auto& [name, laser] : lasers_) {
    Choose(name, laser);
    laser.range_max_m = laser.range_maximum.Estimate();
    laser.next_estimate = 2 * laser.observed;
    any = any || !laser.message.empty();
  }
  if (!any && !lasers_.empty()) {
    throw std::runtime_error("no laser or message '" + options_.laser +
                             "' in this log, which has " + DescribeLasers());
  }
}

bool SweepCompleter::IsWanted(const std::string& name, const Laser& laser) const {
  // Of others it has to be known where they sit; one of another robot is not of this one.
  const bool is_placed = laser.mounting_known || laser.T_robot_laser;
  const bool is_of_robot = name.find('@') == std::string::npos;
  if (options_.laser.empty()) return name == front_ || (is_placed && is_of_robot);
  return options_.laser == "all" || options_.laser == name || laser.sweeps.contains(options_.laser);
}

/// Which message of a laser to deliver: the one that tells most, if it is there for about every
/// sweep.
void SweepCompleter::Choose(const std::string& name, Laser& laser) const {
  laser.decided = true;
  laser.T_robot_laser = laser.mounting.Estimate();
  if (!IsWanted(name, laser)) return;
  std::size_t most = 0;
  for (const auto& [message, count] : laser.sweeps) most = std::max(most, count);
  for (const auto& [message, count] : laser.sweeps) {
    const bool better = laser.message.empty() || Rank(message) > Rank(laser.message);
    if (2 * count >= most && better) laser.message = message;
  }
  const auto asked_for = laser.sweeps.find(options_.laser);
  if (asked_for != laser.sweeps.end()) laser.message = asked_for->first;
}

std::optional<ScanReading> SweepCompleter::Complete(Sweep sweep) {
  const auto found = lasers_.find(sweep.reading.laser);
  if (found == lasers_.end() || found->second.message != sweep.message) return std::nullopt;
  const Laser& laser = found->second;
  LaserGeometry& geometry = sweep.reading.scan.geometry;
  // A stated maximum holds, unless what stands for "no echo" would be taken for echoes.
  const bool stated = geometry.range_max_m > 0.0F;
  if (!stated || laser.range_max_m < kMissShareOfMaximum * geometry.range_max_m) {
    geometry.range_max_m = laser.range_max_m;
  }
  if (options_.range_max_m) geometry.range_max_m = *options_.range_max_m;
  if (options_.mirrored) Mirror(geometry);
  if (!sweep.mounting_known && laser.T_robot_laser) geometry.T_robot_laser = *laser.T_robot_laser;
  if (options_.T_robot_laser) geometry.T_robot_laser = *options_.T_robot_laser;
  return std::move(sweep.reading);
}

std::string SweepCompleter::DescribeLasers() const {
  std::string list;
  for (const auto& [name, laser] : lasers_) {
    for (const auto& [message, count] : laser.sweeps) {
      list += list.empty() ? "" : ", ";
      list += "'" + name + "' (" + std::string(message) + ")";
    }
  }
  return list;
}

}  // namespace qwsm::io
