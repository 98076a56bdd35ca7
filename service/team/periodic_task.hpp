// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace qwsm::team {

/// Does something again and again in a thread of its own, until it goes.
class PeriodicTask {
 public:
  /// @param is_background the thread gives way to all others.
  PeriodicTask(std::chrono::duration<double> period,
               bool is_background,
               std::function<void()> task);

 private:
  std::jthread thread_;
};

}  // namespace qwsm::team
