// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/mapping/observation.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm::pipeline {

/// How far a source has come.
struct SourceProgress {
  std::size_t scans = 0;    ///< Scans given so far.
  std::size_t dropped = 0;  ///< Scans lost on the way here: malformed, or a full queue.
  /// Share of all there is, 0..1; unknown for what has no known end.
  std::optional<double> share{};
  /// Time of a simulation.
  std::optional<std::chrono::duration<double>> simulated{};
};

/// Where observations come from: a log, a simulator, a robot.
class ScanSource {
 public:
  ScanSource() = default;
  ScanSource(const ScanSource&) = delete;
  ScanSource& operator=(const ScanSource&) = delete;
  virtual ~ScanSource() = default;

  /// The next observation, in the order of measurement; nothing at the end.
  virtual std::optional<Observation> Next() = 0;

  virtual SourceProgress progress() const = 0;

  /// True poses of the scans given so far, in some frame of their own; empty where unknown.
  virtual const Trajectory& truth() const {
    static const Trajectory kUnknown;
    return kUnknown;
  }

  /// What was found so far, in lines for the record of the run.
  virtual std::vector<std::string> Describe() const { return {}; }
};

}  // namespace qwsm::pipeline
