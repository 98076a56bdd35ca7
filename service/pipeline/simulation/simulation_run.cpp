// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/simulation_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <thread>

namespace qwsm::pipeline {

bool RunSimulation(sim::Simulation& simulation,
                   std::span<ReadingSink* const> sinks,
                   const std::function<bool()>& stop) {
  while (!stop()) {
    const std::optional<sim::Reading> reading = simulation.Next();
    if (!reading) return true;
    for (ReadingSink* sink : sinks) sink->Take(*reading);
  }
  return false;
}

std::string SimulationProgressLine(const sim::Simulation& simulation,
                                   std::chrono::duration<double> elapsed) {
  const double share = simulation.share_done();
  std::string line = fmt::format("sim  {:2.0f} %  {}",
                                 std::floor(100.0 * share),
                                 SimulatedTimeText(simulation.now(), elapsed));
  if (share > 0.0) line += "  ETA " + MinutesAndSeconds(elapsed.count() * (1.0 / share - 1.0));
  return line;
}

void SimulationProgress::Take(const sim::Reading&) {
  line_.Show([this](std::chrono::duration<double> elapsed) {
    return SimulationProgressLine(simulation_, elapsed);
  });
}

void Pacer::Take(const sim::Reading& reading) {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> simulated = reading.scan.stamp;
  const auto due = std::chrono::round<std::chrono::nanoseconds>(simulated / factor_);
  if (!begin_) begin_ = now - due;
  std::this_thread::sleep_until(*begin_ + due);
}

}  // namespace qwsm::pipeline
