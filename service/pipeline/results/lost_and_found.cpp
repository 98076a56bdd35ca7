// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/results/lost_and_found.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

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
  was_placed_ = true;
  for (StepSink* sink : next_) sink->Take(timed);
}

std::string LostAndFound::PlacesText() const {
  constexpr std::size_t kMost = 5;
  const std::vector<Place>& places = localizer_.belief().places;
  // Places are those of the last look; who is to be told where it began wants to know that.
  const Pose2 T_looked_first =
      localizer_.T_local_looked().value_or(Pose2{}).Inverse() * held_.front().step.map_robot.T_a_b;
  std::string text;
  for (const Place& place : std::span(places).first(std::min(kMost, places.size()))) {
    if (!text.empty()) text += ", ";
    text += fmt::format("{} ({:.0f} %)",
                        PoseText(place.map_robot.T_a_b * T_looked_first),
                        100.0 * place.probability);
  }
  if (places.size() > kMost) text += ", ...";
  return text;
}

}  // namespace qwsm::pipeline
