// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team_log.hpp"

#include <spdlog/spdlog.h>

#include <string_view>

namespace qwsm::pipeline {

void TeamLog::TakeEvent(const team::TeamEvent& event) {
  const std::string_view separator = event.robot.empty() ? "" : ": ";
  spdlog::log(event.is_warning ? spdlog::level::warn : spdlog::level::info,
              "{}{}{}",
              event.robot,
              separator,
              event.text);
}

// Reports come about once a second: however many scans are dropped, that is one message.
void TeamLog::TakeStatus(const team::TeamStatus& status) {
  std::uint64_t dropped = 0;
  for (const team::RobotStatus& robot : status.robots) dropped += robot.counts.dropped;
  if (dropped > dropped_) {
    spdlog::warn("{} scans were dropped: more arrive than can be matched", dropped - dropped_);
  }
  dropped_ = dropped;
}

}  // namespace qwsm::pipeline
