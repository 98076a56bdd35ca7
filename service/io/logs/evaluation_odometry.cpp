// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/logs/evaluation_odometry.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "qwsm/metrics/odometry_carrier.hpp"
#include "service/io/files/number_text.hpp"

namespace qwsm::io {
namespace {

using namespace std::chrono_literals;

constexpr Timestamp kSameReading = 1us;  // A scan repeats the odometry that was read just before.
constexpr Timestamp kSameScan = 100us;   // Trajectories are often written with four decimals.

/// The moments of a log at which odometry was read or a scan was taken, in the order of the file.
class Moments {
 public:
  explicit Moments(LogReader& log) {
    while (const std::optional<LogRecord> record = log.Next()) {
      if (const auto* reading = std::get_if<OdometryReading>(&*record)) Add(*reading);
      if (const auto* scan = std::get_if<ScanReading>(&*record)) Add(*scan);
    }
  }

  /// Gives the next scan of that moment its pose; false if there is none any more.
  bool Estimate(const StampedPose2& pose) {
    const auto is_it = [&](const Scan& scan) {
      return std::chrono::abs(scan.stamp - pose.stamp) <= kSameScan;
    };
    const auto next = scans_.begin() + static_cast<std::ptrdiff_t>(next_scan_);
    const auto scan = std::find_if(next, scans_.end(), is_it);
    if (scan == scans_.end()) return false;
    next_scan_ = static_cast<std::size_t>(std::distance(scans_.begin(), scan)) + 1;
    if (scan->reading) {
      readings_[*scan->reading].T_map_robot = pose.T_map_robot;
    } else {
      without_odometry_.push_back(pose);
    }
    return true;
  }

  Trajectory Carry() const {
    Trajectory trajectory = CarryByOdometry(readings_);
    trajectory.insert(trajectory.end(), without_odometry_.begin(), without_odometry_.end());
    return trajectory;
  }

 private:
  struct Scan {
    Timestamp stamp{};
    std::optional<std::size_t> reading;  // The odometry of its moment.
  };

  void Add(const OdometryReading& reading) {
    readings_.push_back({.stamp = reading.stamp, .T_odom_robot = reading.T_odom_robot});
  }

  void Add(const ScanReading& scan) {
    const bool last_is_scan =
        !scans_.empty() && scans_.back().reading && *scans_.back().reading + 1 == readings_.size();
    const bool repeats = !readings_.empty() && !last_is_scan &&
                         std::chrono::abs(readings_.back().stamp - scan.scan.stamp) <= kSameReading;
    if (!repeats && scan.T_odom_robot) {
      readings_.push_back({.stamp = scan.scan.stamp, .T_odom_robot = *scan.T_odom_robot});
    }
    const bool has_reading = repeats || scan.T_odom_robot;
    scans_.push_back(
        {scan.scan.stamp, has_reading ? std::optional(readings_.size() - 1) : std::nullopt});
  }

  std::vector<CarriedReading> readings_;
  std::vector<Scan> scans_;
  std::size_t next_scan_ = 0;  // After the one that got the last pose.
  Trajectory without_odometry_;
};

}  // namespace

Trajectory CarryToOdometry(LogReader& log, const Trajectory& trajectory) {
  Moments moments(log);
  for (const StampedPose2& pose : trajectory) {
    if (moments.Estimate(pose)) continue;
    std::string message = log.report().name + ": has no scan at ";
    AppendStamp(message, pose.stamp);
    throw std::runtime_error(
        message +
        " s, or not in this order; is the trajectory one of this log, with one "
        "pose per scan?");
  }
  return moments.Carry();
}

}  // namespace qwsm::io
