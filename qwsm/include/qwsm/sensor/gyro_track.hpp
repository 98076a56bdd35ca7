// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "qwsm/sensor/imu_reading.hpp"

namespace qwsm {

/// How far a robot has turned by its gyro: turn rates about the upright axis, summed up as they
/// come (trapezoidal rule). Whoever sums up the same readings gets the same angles, bit for bit.
class GyroTrack {
 public:
  static constexpr std::size_t kUnlimited = 0;

  /// Keeps the last so many readings, or all.
  explicit GyroTrack(std::size_t capacity = kUnlimited) : capacity_(capacity) {}

  /// Takes a reading about the robot's axes.
  /// @return false if it is refused: not later than the one before.
  bool Add(const ImuReading& reading);
  /// Forgets the readings, for what comes next has another clock. Angles go on.
  void Restart() { readings_.clear(); }

  bool empty() const { return readings_.empty(); }
  /// Whether there is a reading of that time or later, so that waiting tells nothing new.
  bool Covers(Timestamp stamp) const;
  /// The angle turned at a moment between two readings, not wrapped; nothing elsewhere, and in
  /// gaps.
  std::optional<double> At(Timestamp stamp) const;

 private:
  struct Turn {
    Timestamp stamp{};
    double rate_rad_s = 0.0;
    double turned_rad = 0.0;
  };

  std::size_t capacity_;
  double turned_rad_ = 0.0;
  std::deque<Turn> readings_;
};

}  // namespace qwsm
