// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "service/pipeline/results/corrected_run.hpp"
#include "service/pipeline/results/run_statistics.hpp"
#include "service/pipeline/results/truth_report.hpp"
#include "service/pipeline/text/json.hpp"

namespace qwsm::pipeline {

/// The matcher's name as it is given after --matcher.
std::string_view Name(MatcherKind matcher);

/// The figures of a run; every name ends in its unit. Names are only ever added.
Json MetricsJson(const RunStatistics& run,
                 const MapFigures& map,
                 MatcherKind matcher,
                 const std::optional<TruthReport>& truth,
                 const std::optional<LoopCounts>& loops = {});

/// The figures of a run in a few lines for people.
std::string SummaryText(const RunStatistics& run,
                        const MapFigures& map,
                        const std::optional<TruthReport>& truth,
                        const std::optional<LoopCounts>& loops = {});

}  // namespace qwsm::pipeline
