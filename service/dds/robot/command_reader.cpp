// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/command_reader.hpp"

#include <cmath>

#include "service/dds/entities/reader.hpp"

namespace qwsm::dds {

class CommandReader::Topic {
 public:
  Topic(const Participant& participant, const RobotNames& names)
      : reader(participant, names.Topic(kCommandTopic), Profile::kSensorIn) {}

  Reader<wire::Twist> reader;
};

CommandReader::CommandReader(const Participant& participant, const RobotNames& names)
    : topic_(std::make_unique<Topic>(participant, names)) {}

CommandReader::~CommandReader() = default;

std::optional<VelocityRequest> CommandReader::Take() {
  std::optional<VelocityRequest> latest;
  topic_->reader.TakeAll([&latest](const wire::Twist& twist) {
    if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z)) return;
    latest = {.forward_mps = twist.linear.x, .turn_rad_s = twist.angular.z};
  });
  return latest;
}

}  // namespace qwsm::dds
