// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>

#include <cstdint>
#include <string_view>

namespace qwsm::pipeline {

/// While an object of this class lives, the first Ctrl-C (SIGINT), SIGTERM or SIGHUP is only noted,
/// so that what was begun can be finished and written; a second Ctrl-C quits at once with exit code
/// 130. What comes within half a second of the first is that one once more: a launcher, or
/// `timeout`, signals the program and its group. A program that was started to ignore Ctrl-C or
/// SIGHUP, as a shell's script starts those behind it and nohup does, goes on to do so. One that
/// lives within another takes the Ctrl-C of its time to itself.
class Interruption {
 public:
  static constexpr std::string_view kFinishing =
      "interrupted: finishing what was begun and writing the results; again to quit at once\n";
  static constexpr std::string_view kListensNoMore =
      "interrupted: listens no more; again to quit at once\n";

  /// What becomes of the program where nobody reads any more what it prints (SIGPIPE).
  enum class WithoutReaders {
    kGoesOn,  ///< There are results to write.
    kEnds,    ///< It only prints.
  };

  /// @param answer is said to whoever presses Ctrl-C; a literal.
  explicit Interruption(std::string_view answer = kFinishing,
                        WithoutReaders without_readers = WithoutReaders::kGoesOn);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  /// Whether it came, by now.
  bool requested() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_hang_up_ {};
  struct sigaction old_pipe_ {};
  std::int64_t outer_requested_at_;
  std::string_view outer_answer_;
};

}  // namespace qwsm::pipeline
