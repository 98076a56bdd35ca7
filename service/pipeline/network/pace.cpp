// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/pace.hpp"

#include <algorithm>
#include <thread>

namespace qwsm::pipeline {

bool Pace::WaitFor(Timestamp stamp, std::chrono::nanoseconds longest) {
  const auto now = std::chrono::steady_clock::now();
  if (!begin_ || stamp < last_) {
    begin_ = now;
    first_ = stamp;
  }
  last_ = stamp;
  const std::chrono::duration<double> after = stamp - first_;
  const auto due = *begin_ + std::chrono::round<std::chrono::nanoseconds>(after / factor_);
  std::this_thread::sleep_until(std::min(due, now + longest));
  return due <= now + longest;
}

}  // namespace qwsm::pipeline
