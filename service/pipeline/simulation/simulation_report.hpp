// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "service/pipeline/simulation/simulated_log.hpp"
#include "sim/simulation.hpp"

namespace qwsm::pipeline {

/// The logs of all robots of a simulation, in their order.
using SimulatedLogs = std::vector<std::unique_ptr<SimulatedLog>>;

/// The figures of a simulation as JSON; every name ends in its unit. Names are only ever added.
std::string SimulationJson(const sim::Simulation& simulation, const SimulatedLogs& logs);

/// The figures of a simulation in a few lines for people.
std::string SimulationSummary(const sim::Simulation& simulation, const SimulatedLogs& logs);

}  // namespace qwsm::pipeline
