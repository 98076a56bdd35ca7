// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <signal.h>

namespace qwsm::pipeline {

/// While an object of this class lives, the first Ctrl-C (SIGINT, or SIGTERM) is only noted, so
/// that what was begun can be finished and written; the second one quits at once with exit code
/// 130.
class Interruption {
 public:
  Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();

  bool requested() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace qwsm::pipeline
