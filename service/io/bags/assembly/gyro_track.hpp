// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "qwsm/sensor/laser_scan.hpp"
#include "service/io/bags/messages/transform3.hpp"

namespace qwsm::io {

/// The readings of a gyro, and how far the robot has turned by them.
class GyroTrack {
 public:
  /// Takes turn rates about the gyro's own axes; they may come in any order.
  void Add(Timestamp stamp, const std::array<double, 3>& turn_rate_rad_s);
  /// Sums up the turns about the robot's upright axis. Call it once, before At().
  /// @param rotation of the gyro on the robot.
  void Integrate(const Quaternion& rotation);

  bool empty() const { return readings_.empty(); }
  std::size_t size() const { return readings_.size(); }
  /// The angle turned at a moment between two readings, not wrapped; nothing elsewhere, and in
  /// gaps.
  std::optional<double> At(Timestamp stamp) const;

 private:
  struct Reading {
    Timestamp stamp{};
    std::array<double, 3> turn_rate_rad_s{};
    double turned_rad = 0.0;
  };
  std::vector<Reading> readings_;
};

}  // namespace qwsm::io
