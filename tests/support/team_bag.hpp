// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/simulation.hpp"

namespace qwsm::test {

/// What the first robots of a simulation measure, in the order of time.
std::vector<sim::Reading> ReadingsOf(const sim::ScenarioOptions& scenario, std::size_t robots);

/// Whether a bag tells odometry.
enum class OdometryOfBag { kWritten, kNone };

/// Writes what several robots measure as one bag, a namespace each, with their true poses; the
/// odometry of each has an origin of its own.
void WriteTeamBag(std::span<const sim::Reading> readings,
                  std::span<const std::string> names,
                  const std::filesystem::path& bag,
                  OdometryOfBag odometry = OdometryOfBag::kWritten);

}  // namespace qwsm::test
