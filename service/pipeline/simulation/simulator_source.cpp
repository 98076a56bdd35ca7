// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/simulation/simulator_source.hpp"

namespace qwsm::pipeline {

std::optional<Observation> SimulatorSource::Next() {
  while (std::optional<sim::Reading> reading = simulation_.Next()) {
    if (reading->robot != robot_) continue;
    truth_.push_back({.stamp = reading->scan.stamp, .T_map_robot = reading->T_world_robot});
    return sim::ObservationOf(*reading);
  }
  return std::nullopt;
}

SourceProgress SimulatorSource::progress() const {
  return {
      .scans = truth_.size(), .share = simulation_.share_done(), .simulated = simulation_.now()};
}

}  // namespace qwsm::pipeline
