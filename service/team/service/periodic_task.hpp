// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <thread>

namespace qwsm::team {

/// Does something again and again in a thread of its own, until it goes.
class PeriodicTask {
 public:
  using Task = std::function<void(const std::stop_token&)>;

  /// Starts the thread.
  /// @param is_background the thread gives way to all others.
  /// @param task is called with what tells it to hurry up, for there is to be an end.
  PeriodicTask(std::chrono::duration<double> period, bool is_background, Task task);

 private:
  std::jthread thread_;
};

}  // namespace qwsm::team
