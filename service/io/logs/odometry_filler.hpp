// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>

#include "qwsm/logs/log_record.hpp"

namespace qwsm::io {

/// Gives sweeps whose message has no pose the odometry of their moment, between the readings that
/// came before and after them. The order of the records stays.
class OdometryFiller {
 public:
  void Push(LogRecord record);
  /// Says that no more records will come: what waits for odometry waits in vain.
  void Finish();
  /// The next record that is complete, if any.
  std::optional<LogRecord> Take();

 private:
  std::optional<Pose2> Interpolate(Timestamp stamp) const;
  bool MustWait(Timestamp stamp) const;

  std::deque<LogRecord> held_;
  std::deque<OdometryReading> odometry_;  // The latest readings.
  std::size_t held_readings_ = 0;
  bool finished_ = false;
};

}  // namespace qwsm::io
