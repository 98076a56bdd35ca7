// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace qwsm::pipeline {

/// Lets a message through, and one of the same text again only after a while: what goes wrong ten
/// times a second is worth a line, not ten a second. Any thread may ask.
class RepeatFilter {
 public:
  using Clock = std::chrono::steady_clock;

  explicit RepeatFilter(Clock::duration period) : period_(period) {}

  /// Asks for leave to tell a text.
  /// @return how often it was held back since it was let through; nothing if it is held back now.
  std::optional<std::size_t> Pass(const std::string& text, Clock::time_point now);

 private:
  struct Told {
    Clock::time_point at{};
    std::size_t held_back = 0;
  };

  Clock::duration period_;
  std::mutex mutex_;
  std::map<std::string, Told> told_;
};

}  // namespace qwsm::pipeline
