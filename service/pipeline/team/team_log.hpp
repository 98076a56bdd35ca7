// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/pipeline/team/repeat_filter.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::pipeline {

/// Turns what is worth a line into messages, the same one at most every ten seconds.
class TeamLog final : public team::TeamSink {
 public:
  void TakeAnswer(const team::RobotAnswer&) override {}
  void TakeReport(const team::RobotAnswer&) override {}
  void TakeRelevantScan(const team::TeamScan&) override {}
  void TakeNewPoints(const team::NewPoints&) override {}
  void TakeMap(const team::MapPicture&) override {}
  void TakeStatus(const team::TeamStatus& status) override;
  void TakeEvent(const team::TeamEvent& event) override;

 private:
  RepeatFilter repeats_{std::chrono::seconds(10)};
  std::uint64_t dropped_ = 0;  // As told last.
};

}  // namespace qwsm::pipeline
