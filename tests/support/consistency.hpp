// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/metrics/nees.hpp"
#include "tests/support/simulated_drive.hpp"

/// Whether the mapper is as uncertain as it should be: its answers against the truth of simulated
/// drives.
namespace qwsm::test {

/// A scene, and how it is driven through.
struct ConsistencyScenario {
  std::string name;
  Scene scene;
  DriveOptions drive;
  double axis_rad = 0.0;  ///< In the world: of the corridor, or of the longer side.
};

/// Room, two rooms, an office loop, a corridor whose ends are always seen, one whose ends are not,
/// and a park with few trees.
std::vector<ConsistencyScenario> ConsistencyScenarios();

/// What is asked of the mapper.
enum class ConsistencyTask {
  kLocalize,  ///< The map is given and true: the answers of the matcher, one by one.
  kMap,       ///< Mapping from nothing: drift counts, and is to be admitted.
};

/// Root mean squares of what was wrong, and of how wrong the mapper thought it might be.
struct ErrorAndSigma {
  double error = 0.0;
  double sigma = 0.0;
};

struct ConsistencyResult {
  NeesSummary nees;
  ErrorAndSigma along_m;  ///< The scenario's axis.
  ErrorAndSigma across_m;
  ErrorAndSigma heading_rad;
  int without_covariance = 0;  ///< Answers whose covariance is not positive definite.
  int dead_reckoned = 0;
};

/// Drives through the scenario once per seed, from 1 to `seeds`, and compares every answer but the
/// first with the truth.
ConsistencyResult EvaluateConsistency(const ConsistencyScenario& scenario,
                                      ConsistencyTask task,
                                      const MapperOptions& options,
                                      std::uint64_t seeds);

}  // namespace qwsm::test
