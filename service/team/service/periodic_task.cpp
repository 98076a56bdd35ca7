// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/periodic_task.hpp"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "service/team/map/yielding.hpp"

namespace qwsm::team {
PeriodicTask::PeriodicTask(std::chrono::duration<double> period, bool is_background, Task task)
    : thread_([period, is_background, task = std::move(task)](const std::stop_token& stop) {
        if (is_background) YieldToOthers();
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        const auto never = [] { return false; };
        while (!stop.stop_requested()) {
          task(stop);
          stopped.wait_for(lock, stop, period, never);
        }
      }) {}

}  // namespace qwsm::team
