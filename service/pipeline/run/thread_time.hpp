// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

#include <chrono>

namespace qwsm::pipeline {

/// Processor time of the calling thread since it began. Unlike a wall clock it does not count what
/// other programs take of the machine meanwhile.
inline std::chrono::nanoseconds WorkedByThread() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace qwsm::pipeline
