// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>

#include <string_view>

namespace qwsm::pipeline {

/// While an object of this class lives, the first Ctrl-C (SIGINT, or SIGTERM) is only noted, so
/// that what was begun can be finished and written; the second one quits at once with exit code
/// 130. A program that was started to ignore Ctrl-C, as a shell's script starts those behind it,
/// goes on to do so. One that lives within another takes the Ctrl-C of its time to itself.
class Interruption {
 public:
  static constexpr std::string_view kFinishing =
      "interrupted: finishing what was begun and writing the results; again to quit at once\n";

  /// @param answer is said to whoever presses Ctrl-C; a literal.
  explicit Interruption(std::string_view answer = kFinishing);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Whether it came, by now.
  bool requested() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  bool outer_requested_;
  std::string_view outer_answer_;
};

}  // namespace qwsm::pipeline
