// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/entities/participant.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/session/robot_listener.hpp"

namespace qwsm::dds {

/// Hears what one robot says, for programs that are not the service.
class RobotFeed {
 public:
  /// Subscribes to a robot's topics.
  /// @param scan_topics below its namespace. @param participant and refusals outlive this.
  RobotFeed(const Participant& participant,
            const RobotNames& names,
            const std::vector<std::string>& scan_topics,
            Refusals& refusals);
  ~RobotFeed();

  /// Waits until something has arrived, or for the timeout, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout, team::RobotListener<team::Planar>& listener);

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace qwsm::dds
