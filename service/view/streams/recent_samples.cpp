// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/view/streams/recent_samples.hpp"

#include <algorithm>
#include <utility>

namespace qwsm::view {

void RecentSamples::Add(Sample sample) {
  samples_.push_back(std::move(sample));
  ++end_;
  if (samples_.size() > options_.depth) samples_.pop_front();
}

Cursor RecentSamples::Begin() const {
  switch (options_.for_late_comers) {
    case ForLateComers::kNothing:
      return end_;
    case ForLateComers::kLast:
      return samples_.empty() ? end_ : end_ - 1;
    case ForLateComers::kAll:
      break;
  }
  return first();
}

std::optional<Sample> RecentSamples::Next(Cursor& cursor, Clock::time_point now) const {
  if (cursor >= end_) return std::nullopt;
  cursor = std::max(cursor, first());
  const auto at = [this](Cursor number) -> const Sample& { return samples_[number - first()]; };
  if (options_.for_late_comers != ForLateComers::kAll) {
    while (cursor + 1 < end_ && now - at(cursor).arrived > options_.outdated) ++cursor;
  }
  return at(cursor++);
}

}  // namespace qwsm::view
