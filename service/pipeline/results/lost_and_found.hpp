// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "qwsm/mapping/localizer.hpp"
#include "service/pipeline/results/kept_steps.hpp"
#include "service/pipeline/run/step_sink.hpp"

namespace qwsm::pipeline {

/// Holds back the answers while a robot is lost, and passes them on, placed in the map, once it is
/// found. Tells of both.
class LostAndFound final : public StepSink {
 public:
  /// @param next take the answers in the map. @pre all outlive this.
  LostAndFound(const Localizer& localizer, std::vector<StepSink*> next)
      : localizer_(localizer), next_(std::move(next)) {}

  void Take(const TimedStep& timed) override;

  /// How many answers could not be placed.
  std::size_t held() const { return held_.size(); }
  /// Whether the robot was found nowhere yet.
  bool is_lost_from_start() const { return !was_placed_; }
  /// The places where the robot may have been at the first of those answers, as `x y heading (48
  /// %)`, in metres and degrees. @pre held() > 0
  std::string PlacesText() const;

 private:
  const Localizer& localizer_;
  std::vector<StepSink*> next_;
  KeptSteps held_;
  bool was_placed_ = false;
};

}  // namespace qwsm::pipeline
