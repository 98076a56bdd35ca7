// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "service/dds/entities/participant.hpp"
#include "service/team/scans/team_scan.hpp"

namespace qwsm::pipeline {

/// Hears the map that services share: the relevant scans of all robots, by service, robot and
/// number, each once, where the last correction has put them; those in components of their own are
/// left out, and told. Waits ten seconds for the first, and then until none has come for a second,
/// at most a minute in all: robots that drive send more of them.
/// @param should_stop ends the wait. @returns none where nobody shares any.
std::vector<team::TeamScan> HearTeamScans(const dds::Participant& participant,
                                          const std::function<bool()>& should_stop);

}  // namespace qwsm::pipeline
