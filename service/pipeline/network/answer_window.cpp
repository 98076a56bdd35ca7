// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/network/answer_window.hpp"

#include <algorithm>

namespace qwsm::pipeline {

// The middleware may wake up who waits for an answer without there being one.
template <class Kind>
bool BasicAnswerWindow<Kind>::WaitFor(std::size_t most, std::chrono::nanoseconds patience) {
  auto until = Clock::now() + patience;
  while (unanswered_.size() > most) {
    const Clock::time_point now = Clock::now();
    if (now >= until) {
      unanswered_.clear();
      return false;
    }
    if (Take(until - now)) until = Clock::now() + patience;
  }
  return true;
}

template <class Kind>
bool BasicAnswerWindow<Kind>::Take(std::chrono::nanoseconds timeout) {
  bool came = false;
  for (const auto& report : reports_.Take(timeout)) {
    came = true;
    ++answered_;
    dropped_ = std::max(dropped_, report.dropped);
    // A service answers in order: what is older will have no answer any more.
    const auto answered = std::ranges::find(unanswered_, report.stamp);
    if (answered != unanswered_.end()) unanswered_.erase(unanswered_.begin(), answered + 1);
  }
  return came;
}

template class BasicAnswerWindow<team::Planar>;
template class BasicAnswerWindow<team::Spatial>;

}  // namespace qwsm::pipeline
