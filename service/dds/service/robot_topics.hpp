// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/service/other_services.hpp"

namespace qwsm::dds {

/// Topics that a service keeps for each of its robots.
class RobotTopics {
 public:
  RobotTopics() = default;
  RobotTopics(const RobotTopics&) = delete;
  RobotTopics& operator=(const RobotTopics&) = delete;
  virtual ~RobotTopics() = default;

  /// Makes the topics of a robot, so that listeners find them before its first scan is answered.
  virtual void AddRobot(const std::string& robot, const Claim& claim) = 0;
  /// Takes away the topics of a robot: another service answers it. What is still on its way is
  /// dropped.
  virtual void RemoveRobot(const std::string& robot) = 0;
};

}  // namespace qwsm::dds
