// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace qwsm {

/// Time since the epoch of whoever measured. Nanoseconds hold a log's microseconds exactly.
using Timestamp = std::chrono::nanoseconds;

/// A duration, or a time since the epoch, in seconds.
inline double Seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace qwsm
