// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "service/dds/service/mark_exchange.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::dds {

/// Moves marks when the service corrects its map.
class TeamMarkPlaces final : public team::TeamSink {
 public:
  /// @param marks outlives this.
  explicit TeamMarkPlaces(MarkExchange& marks) : marks_(marks) {}

  void TakeEpoch(const team::TeamEpoch& epoch) override { marks_.Follow(epoch); }

 private:
  MarkExchange& marks_;
};

}  // namespace qwsm::dds
