// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/repeat_filter.hpp"

#include <utility>

namespace qwsm::pipeline {
namespace {

// Names in messages come from the network: they must not fill the memory.
constexpr std::size_t kMaxTexts = 1000;

}  // namespace

std::optional<std::size_t> RepeatFilter::Pass(const std::string& text, Clock::time_point now) {
  const std::lock_guard lock(mutex_);
  const auto known = told_.find(text);
  if (known == told_.end()) {
    if (told_.size() >= kMaxTexts) told_.clear();
    told_[text] = {.at = now};
    return 0;
  }
  Told& told = known->second;
  if (now - told.at < period_) {
    ++told.held_back;
    return std::nullopt;
  }
  told.at = now;
  return std::exchange(told.held_back, 0);
}

}  // namespace qwsm::pipeline
