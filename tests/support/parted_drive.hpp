// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "sim/scenario.hpp"
#include "sim/simulation.hpp"

namespace qwsm::test {

/// A recorded drive in so many parts, each driven by a robot of its own, all at the same time. Its
/// poses are those of the whole drive once its loops are closed.
std::vector<sim::Reading> PartedLog(const std::filesystem::path& path, int robots);

/// The same of a simulated drive of one robot, whose poses are the true ones.
std::vector<sim::Reading> PartedDrive(const sim::ScenarioOptions& scenario, int robots);

}  // namespace qwsm::test
