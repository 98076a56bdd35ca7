// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "service/pipeline/team/repeat_filter.hpp"
#include "service/team/sinks/cloud_sink.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::pipeline {

/// Turns what is worth a line into messages, each of one text at most every ten seconds.
/// @tparam Sink team::TeamSink or team::CloudSink.
template <class Sink>
class TeamLog final : public Sink {
 public:
  void TakeStatus(const team::TeamStatus& status) override;
  void TakeEvent(const team::TeamEvent& event) override;

 private:
  RepeatFilter repeats_{std::chrono::seconds(10)};
  std::uint64_t dropped_ = 0;  // Drops as told last.
};

extern template class TeamLog<team::TeamSink>;
extern template class TeamLog<team::CloudSink>;

}  // namespace qwsm::pipeline
