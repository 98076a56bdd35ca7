// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace qwsm::apps {

/// Longest time that a command is given, in seconds: some thirty years.
inline constexpr double kLongest_s = 1e9;

/// Most things that a command is told to count: more than there will ever be.
inline constexpr double kMostCounted = 1e15;

/// The check() of an option that takes a number between two others; neither nan nor inf passes.
CLI::Validator NumberBetween(double least, double most);

}  // namespace qwsm::apps
