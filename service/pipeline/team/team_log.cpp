// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/team_log.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {

template <class Sink>
void TeamLog<Sink>::TakeEvent(const team::TeamEvent& event) {
  const std::string subject = event.robot ? team::DisplayName(*event.robot) + ": " : "";
  const std::string text = subject + std::string(event.text);
  const std::optional<std::size_t> held_back = repeats_.Pass(text, RepeatFilter::Clock::now());
  if (!held_back) return;
  const std::string line =
      text + (*held_back > 0 ? fmt::format(" ({} times more since)", *held_back) : "");
  event.is_warning ? messages::Warn(line) : messages::Info(line);
}

template <class Sink>
void TeamLog<Sink>::TakeStatus(const team::TeamStatus& status) {
  std::uint64_t dropped = 0;
  for (const team::RobotStatus& robot : status.robots) dropped += robot.counts.dropped;
  if (dropped == dropped_ || !repeats_.Pass("dropped", RepeatFilter::Clock::now())) return;
  messages::Warn("{} scans were dropped: more arrive than can be matched", dropped - dropped_);
  dropped_ = dropped;
}

template class TeamLog<team::TeamSink>;
template class TeamLog<team::CloudSink>;

}  // namespace qwsm::pipeline
