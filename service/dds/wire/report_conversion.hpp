// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "service/dds/entities/wire_types.hpp"
#include "service/dds/wire/match_report.hpp"
#include "service/team/sinks/service_sink.hpp"

namespace qwsm::dds {

/// The report that tells others what an answer says.
MatchReport ReportOf(const team::RobotAnswer& answer);

/// Makes a sample that points into the report and the name of the frame: write it while both live.
wire::MatchReport ToWire(const MatchReport& report, const std::string& map_frame);

/// The report of a sample; nothing where the sample makes no sense.
std::optional<MatchReport> FromWire(const wire::MatchReport& sample);

}  // namespace qwsm::dds
