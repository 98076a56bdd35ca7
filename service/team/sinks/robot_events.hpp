// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "service/team/sinks/service_sink.hpp"

namespace qwsm::team {

/// Tells of events of one robot.
class RobotEvents {
 public:
  RobotEvents(std::string robot, TellEvent tell)
      : robot_(std::move(robot)), tell_(std::move(tell)) {}

  const std::string& robot() const { return robot_; }

  void Inform(std::string_view text) const {
    tell_({.robot = robot_, .is_warning = false, .text = text});
  }
  void Warn(std::string_view text) const {
    tell_({.robot = robot_, .is_warning = true, .text = text});
  }

 private:
  std::string robot_;
  TellEvent tell_;
};

}  // namespace qwsm::team
