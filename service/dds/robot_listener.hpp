// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::dds {

/// Takes what robots say, converted. Robots are named as in RobotNames.
class RobotListener {
 public:
  RobotListener() = default;
  RobotListener(const RobotListener&) = delete;
  RobotListener& operator=(const RobotListener&) = delete;
  virtual ~RobotListener() = default;

  virtual void TakeScan(const std::string& robot, LaserScan scan) = 0;
  virtual void TakeOdometry(const std::string& robot,
                            Timestamp stamp,
                            const Pose2& T_odom_robot) = 0;
  /// Whether somebody publishes odometry; told again and again.
  virtual void TakeOdometryUse(const std::string& robot, bool is_published) = 0;
  /// Somebody says where the robot is in the map.
  virtual void TakeInitialPose(const std::string& robot, const UncertainPose2& map_robot) = 0;
};

}  // namespace qwsm::dds
