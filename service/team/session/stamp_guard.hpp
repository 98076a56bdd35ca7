// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <set>

namespace qwsm::team {

/// What a stamp says about the message that carries it.
enum class StampVerdict {
  kInOrder,  ///< The stamp is newer than all before.
  /// The stamp is older than the newest by no more than a network delays: it was overtaken.
  kLate,
  kDuplicate,   ///< The stamp is that of a message that has come already.
  kWrongTime,   ///< The stamp is from the future, or older than any delay explains.
  kClockReset,  ///< The stamp is in order again, by a clock that was set.
};

/// Watches the stamps of one sender. What is of a wrong time is to be refused; but when several
/// messages in a row, in order among themselves, are, then it is the clock that was wrong, before
/// or now, and from then on the new time counts.
///
/// A log is played back with its own stamps and may pause for as long as it likes: all of it is
/// past. From the future is what is newer than both this machine's time and all before.
class StampGuard {
 public:
  using Clock = std::chrono::nanoseconds (*)();  ///< Gives the time since 1970.

  static constexpr std::chrono::nanoseconds kMaxDelay = std::chrono::seconds(1);
  /// Most by which clocks may differ, and messages of a wrong time that follow each other be apart.
  static constexpr std::chrono::nanoseconds kMaxAhead = std::chrono::hours(1);
  static constexpr int kConfirmations = 3;
  static constexpr std::size_t kRemembered = 64;  ///< Stamps remembered, to know duplicates by.

  explicit StampGuard(Clock now = SystemTime) : now_(now) {}

  StampVerdict Judge(std::chrono::nanoseconds stamp);

 private:
  static std::chrono::nanoseconds SystemTime();

  StampVerdict Doubt(std::chrono::nanoseconds stamp);
  void Remember(std::chrono::nanoseconds stamp);

  Clock now_;
  std::set<std::chrono::nanoseconds> recent_;  // The newest stamps.
  std::chrono::nanoseconds last_wrong_{};
  int wrong_in_order_ = 0;
};

}  // namespace qwsm::team
