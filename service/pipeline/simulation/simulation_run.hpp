// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "service/pipeline/run/progress_display.hpp"
#include "service/pipeline/simulation/reading_sink.hpp"
#include "sim/simulation.hpp"

namespace qwsm::pipeline {

/// Hands every reading of a simulation to all sinks until it is over.
/// @param stop asked before every reading; when true, the run ends.
/// @returns whether the simulation came to its end.
bool RunSimulation(sim::Simulation& simulation,
                   std::span<ReadingSink* const> sinks,
                   const std::function<bool()>& stop);

/// Progress as `sim  62 %  504 s simulated  3100 x real time  ETA 0:07`.
std::string SimulationProgressLine(const sim::Simulation& simulation,
                                   std::chrono::duration<double> elapsed);

/// Shows how far a simulation has come.
class SimulationProgress final : public ReadingSink {
 public:
  SimulationProgress(const sim::Simulation& simulation, ProgressStyle style)
      : simulation_(simulation), line_(style) {}

  void Take(const sim::Reading&) override;
  void Clear() { line_.Clear(); }

 private:
  const sim::Simulation& simulation_;
  StatusLine line_;
};

/// Waits until readings are due, where simulated time is not to run as fast as it can.
class Pacer final : public ReadingSink {
 public:
  /// Sets the pace. @param factor simulated seconds in a real one. @pre factor > 0
  explicit Pacer(double factor) : factor_(factor) {}

  void Take(const sim::Reading& reading) override;

 private:
  double factor_;
  std::optional<std::chrono::steady_clock::time_point> begin_;
};

}  // namespace qwsm::pipeline
