// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

namespace qwsm::team {

/// What a stamp says about the message that carries it.
enum class StampVerdict {
  kInOrder,     ///< Newer than all before.
  kDuplicate,   ///< As the newest.
  kLate,        ///< Older than the newest: sent twice, overtaken, or from a clock gone wrong.
  kClockReset,  ///< In order again, by a clock that was set back.
};

/// Watches the stamps of one sender. What is late is to be refused; but when several messages in a
/// row, in order among themselves, are late by more than any network delays them, then it is the
/// clock that was wrong, before or now, and from then on the new time counts.
class StampGuard {
 public:
  static constexpr std::chrono::nanoseconds kMaxDelay = std::chrono::seconds(1);
  static constexpr int kConfirmations = 3;

  StampVerdict Judge(std::chrono::nanoseconds stamp);

 private:
  std::optional<std::chrono::nanoseconds> newest_;
  std::chrono::nanoseconds newest_late_{};
  int late_in_order_ = 0;
};

}  // namespace qwsm::team
