// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::pipeline {

/// Waits until things are due that happened, or are simulated, on another clock.
class Pace {
 public:
  /// Sets the pace. @param factor seconds of the other clock in one of ours. @pre factor > 0
  explicit Pace(double factor) : factor_(factor) {}

  /// Sleeps until `stamp` is due, but never for longer than `longest`; returns whether it is due.
  /// The first stamp is due at once; so is one whose clock went back, and the next are due after
  /// it.
  bool WaitFor(Timestamp stamp, std::chrono::nanoseconds longest);

 private:
  double factor_;
  std::optional<std::chrono::steady_clock::time_point> begin_;
  Timestamp first_{};
  Timestamp last_{};
};

}  // namespace qwsm::pipeline
