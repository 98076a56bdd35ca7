// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "qwsm/logs/log_reader.hpp"
#include "service/io/logs/log_parser.hpp"
#include "service/io/logs/mounting.hpp"
#include "service/io/logs/range_maximum.hpp"

namespace qwsm::io {

/// Chooses which sweeps of a log are delivered and supplies what their lines leave open.
///
/// First it is shown the beginning of the log; after Decide() it is shown, and asked about, one
/// sweep after the other.
class SweepCompleter {
 public:
  explicit SweepCompleter(LogOptions options) : options_(std::move(options)) {}

  /// Learns from a sweep, and from the odometry that came before it where it has none itself.
  void Observe(const Sweep& sweep, const std::optional<Pose2>& T_odom_robot);

  /// Chooses the lasers and the messages from what was seen so far.
  /// @throws std::runtime_error where the laser that was asked for is not among those seen.
  void Decide();

  /// The completed sweep; nothing where it is of another laser, or the same sweep in another
  /// message.
  std::optional<ScanReading> Complete(Sweep sweep);

 private:
  struct Laser {
    std::map<std::string_view, std::size_t> sweeps;  // Number of sweeps, by message.
    RangeMaximumEstimator range_maximum;
    MountingEstimator mounting;
    bool mounting_known = false;  // The log says where it sits.
    bool decided = false;
    std::string_view message;  // The message that is delivered, if any.
    float range_max_m = 0.0F;
    std::optional<Pose2> T_robot_laser;
    std::size_t observed = 0;
    std::size_t next_estimate = 0;
  };

  bool IsWanted(const std::string& name, const Laser& laser) const;
  void Choose(const std::string& name, Laser& laser) const;
  std::string DescribeLasers() const;

  LogOptions options_;
  std::map<std::string, Laser, std::less<>> lasers_;
  bool decided_ = false;
  std::string front_;  // The laser that is taken when none was asked for.
};

}  // namespace qwsm::io
