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

 private:
  const Localizer& localizer_;
  std::vector<StepSink*> next_;
  KeptSteps held_;
};

/// The places where a robot may be, as `x y heading (48 %)`, in metres and degrees.
std::string PlacesText(const PlaceBelief& belief);

}  // namespace qwsm::pipeline
