// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <future>
#include <utility>

namespace qwsm::team {

/// Lets the calling thread give way to all that answer scans. Linux gives every thread a priority
/// of its own; that of id 0 is the caller's.
inline void YieldToOthers() {
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, 0, kNice);
}

/// Does some work in a thread that gives way, and waits for its end: who has given way once may not
/// be allowed to come back.
template <class Work>
void DoYielding(Work work) {
  std::async(std::launch::async, [&work] {
    YieldToOthers();
    work();
  }).get();
}

}  // namespace qwsm::team
