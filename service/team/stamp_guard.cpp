// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/stamp_guard.hpp"

#include <utility>

namespace qwsm::team {

StampVerdict StampGuard::Judge(std::chrono::nanoseconds stamp) {
  if (!newest_ || stamp > *newest_) {
    newest_ = stamp;
    late_in_order_ = 0;
    return StampVerdict::kInOrder;
  }
  if (stamp == *newest_) return StampVerdict::kDuplicate;
  if (*newest_ - kMaxDelay < stamp) return StampVerdict::kLate;

  const bool follows = late_in_order_ > 0 && stamp > newest_late_;
  late_in_order_ = follows ? late_in_order_ + 1 : 1;
  newest_late_ = stamp;
  if (late_in_order_ < kConfirmations) return StampVerdict::kLate;
  newest_ = stamp;
  late_in_order_ = 0;
  return StampVerdict::kClockReset;
}

}  // namespace qwsm::team
