// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "qwsm/metrics/stamped_pose.hpp"
#include "service/pipeline/run/scan_source.hpp"
#include "sim/simulation.hpp"

namespace qwsm::pipeline {

/// What one robot of a simulation measures, and where it really was.
class SimulatorSource final : public ScanSource {
 public:
  /// Starts a simulation. @throws sim::ScenarioError. @pre robot < scenario.robots.size()
  SimulatorSource(const sim::ScenarioOptions& scenario, std::size_t robot)
      : simulation_(scenario), robot_(robot) {}

  std::optional<Observation> Next() override;
  SourceProgress progress() const override;

  /// The true pose in the world at every scan given so far.
  const Trajectory& truth() const override { return truth_; }
  const sim::Simulation& simulation() const { return simulation_; }

 private:
  sim::Simulation simulation_;
  std::size_t robot_;
  Trajectory truth_;
};

}  // namespace qwsm::pipeline
