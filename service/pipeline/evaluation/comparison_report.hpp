// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <string>

#include "service/pipeline/evaluation/matcher_contest.hpp"

namespace qwsm::pipeline {

// All functions here require a contestant.

/// A table with a line per scan: status, residual, trace and time of every matcher.
std::string ComparisonCsv(const std::list<Contestant>& contestants);

/// JSON with the figures of every matcher, and the first one's beside those of each other. Names
/// are only ever added.
std::string ComparisonJson(const std::list<Contestant>& contestants);

/// Two tables for people with the figures of every matcher, and the first one's beside those of
/// each other.
std::string ComparisonText(const std::list<Contestant>& contestants);

}  // namespace qwsm::pipeline
