// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "service/dds/entities/participant.hpp"
#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {

/// What somebody asks of a robot (geometry_msgs/Twist on cmd_vel).
struct VelocityRequest {
  double forward_mps = 0.0;
  double turn_rad_s = 0.0;  ///< Counter-clockwise rate, in rad/s.
};

/// Hears the commands to one robot.
class CommandReader {
 public:
  CommandReader(const Participant& participant, const RobotNames& names);
  ~CommandReader();

  /// The latest command since the last call, if there is one; commands that are not finite are
  /// passed over.
  std::optional<VelocityRequest> Take();

 private:
  class Topic;
  std::unique_ptr<Topic> topic_;
};

}  // namespace qwsm::dds
