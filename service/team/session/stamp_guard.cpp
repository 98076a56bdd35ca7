// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/stamp_guard.hpp"

#include <algorithm>

namespace qwsm::team {

std::chrono::nanoseconds StampGuard::SystemTime() {
  return std::chrono::system_clock::now().time_since_epoch();
}

StampVerdict StampGuard::Judge(std::chrono::nanoseconds stamp) {
  if (recent_.contains(stamp)) return StampVerdict::kDuplicate;
  if (!recent_.empty()) {
    const std::chrono::nanoseconds newest = *recent_.rbegin();
    const bool is_ahead = stamp > std::max(newest, now_()) + kMaxAhead;
    if (stamp <= newest - kMaxDelay || is_ahead) return Doubt(stamp);
    if (stamp < newest) {
      Remember(stamp);
      return StampVerdict::kLate;
    }
  }
  wrong_in_order_ = 0;
  Remember(stamp);
  return StampVerdict::kInOrder;
}

StampVerdict StampGuard::Doubt(std::chrono::nanoseconds stamp) {
  const bool follows =
      wrong_in_order_ > 0 && stamp > last_wrong_ && stamp <= last_wrong_ + kMaxAhead;
  wrong_in_order_ = follows ? wrong_in_order_ + 1 : 1;
  last_wrong_ = stamp;
  if (wrong_in_order_ < kConfirmations) return StampVerdict::kWrongTime;
  recent_.clear();
  wrong_in_order_ = 0;
  Remember(stamp);
  return StampVerdict::kClockReset;
}

void StampGuard::Remember(std::chrono::nanoseconds stamp) {
  recent_.insert(stamp);
  if (recent_.size() > kRemembered) recent_.erase(recent_.begin());
}

}  // namespace qwsm::team
