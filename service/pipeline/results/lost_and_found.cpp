// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/lost_and_found.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "qwsm/geometry/angle.hpp"
#include "service/pipeline/text/messages.hpp"

namespace qwsm::pipeline {
namespace {

std::string PoseText(const Pose2& pose) {
  return fmt::format("{:.2f} {:.2f} {:.1f}", pose.x_m, pose.y_m, RadiansToDegrees(pose.theta_rad));
}

}  // namespace

void LostAndFound::Take(const TimedStep& timed) {
  if (timed.step.status == StepStatus::kLost) {
    if (held() == 0) messages::Info("the robot is looked for in the whole map");
    held_.Take(timed);
    return;
  }
  if (held() > 0) {
    messages::Info(
        "found at {} with scan {} of the search", PoseText(timed.step.map_robot.T_a_b), held() + 1);
    // What the robot did meanwhile is known as well as if it had been tracked, but for where.
    held_.PassOn(localizer_.map_local(), next_);
  }
  for (StepSink* sink : next_) sink->Take(timed);
}

std::string PlacesText(const PlaceBelief& belief) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (const Place& place : std::span(belief.places).first(std::min(kMost, belief.places.size()))) {
    if (!text.empty()) text += ", ";
    text +=
        fmt::format("{} ({:.0f} %)", PoseText(place.map_robot.T_a_b), 100.0 * place.probability);
  }
  if (belief.places.size() > kMost) text += ", ...";
  return text;
}

}  // namespace qwsm::pipeline
