// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/pace.hpp"

#include <thread>

namespace qwsm::pipeline {

bool Pace::WaitFor(Timestamp stamp, std::chrono::nanoseconds longest) {
  const auto now = std::chrono::steady_clock::now();
  if (!begin_ || stamp < last_) {
    begin_ = now;
    first_ = stamp;
  }
  last_ = stamp;
  const auto until = now + longest;
  // In seconds until it is known to be near: slowed down, a record may outlast the clock.
  const std::chrono::duration<double> recorded = stamp - first_;
  const std::chrono::duration<double> after = recorded / factor_;
  const bool is_due = after <= until - *begin_;
  std::this_thread::sleep_until(
      is_due ? *begin_ + std::chrono::round<std::chrono::nanoseconds>(after) : until);
  return is_due;
}

}  // namespace qwsm::pipeline
