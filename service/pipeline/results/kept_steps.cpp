// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/kept_steps.hpp"

namespace qwsm::pipeline {

void KeptSteps::Take(const TimedStep& timed) {
  steps_.push_back(timed);
  steps_.back().scan = nullptr;  // It goes when this returns.
  steps_.back().step.relevant_scan = {};
}

void KeptSteps::PassOn(const UncertainPose2& map_own, std::span<StepSink* const> next) {
  for (TimedStep& timed : steps_) {
    timed.step.map_robot = map_own * timed.step.map_robot;
    for (StepSink* sink : next) sink->Take(timed);
  }
  steps_.clear();
}

}  // namespace qwsm::pipeline
