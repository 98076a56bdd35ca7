// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>

#include "qwsm/mapping/mapper.hpp"

namespace qwsm::pipeline {

/// The mapper's answer, and how long it took to give.
struct TimedStep {
  MappingStep step;
  std::chrono::nanoseconds duration{};
  std::chrono::nanoseconds worked{};  ///< Of that, processor time: what a quiet machine would take.
  std::optional<Pose2> T_odom_robot{};  ///< Odometry that the mapper was given.
  /// The scan, for as long as StepSink::Take() runs; none where the answer was held back.
  const LaserScan* scan = nullptr;
};

/// Whether the pose of a step comes from a match.
inline bool HasMatch(StepStatus status) {
  return status == StepStatus::kMatched || status == StepStatus::kExtended;
}

/// Takes the mapper's answers: files, topics, a display.
class StepSink {
 public:
  StepSink() = default;
  StepSink(const StepSink&) = delete;
  StepSink& operator=(const StepSink&) = delete;
  virtual ~StepSink() = default;

  virtual void Take(const TimedStep& timed) = 0;
};

}  // namespace qwsm::pipeline
