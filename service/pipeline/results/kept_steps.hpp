// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Keeps what a robot was answered until it is known where that is; scans are not kept.
class KeptSteps final : public StepSink {
 public:
  void Take(const TimedStep& timed) override;

  /// Passes all on, placed in the map, and keeps none of them.
  /// @param map_own the frame that they were answered in.
  void PassOn(const UncertainPose2& map_own, std::span<StepSink* const> next);

  std::size_t size() const { return steps_.size(); }
  /// The first answer. @pre there is one
  const TimedStep& front() const { return steps_.front(); }

 private:
  std::vector<TimedStep> steps_;
};

}  // namespace qwsm::pipeline
