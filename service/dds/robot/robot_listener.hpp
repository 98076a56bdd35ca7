// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::dds {

/// Takes what robots say, converted. Robots are named as in RobotNames.
/// @tparam Kind team::Planar or team::Spatial.
template <class Kind>
class BasicRobotListener {
 public:
  BasicRobotListener() = default;
  BasicRobotListener(const BasicRobotListener&) = delete;
  BasicRobotListener& operator=(const BasicRobotListener&) = delete;
  virtual ~BasicRobotListener() = default;

  virtual void TakeScan(const std::string& robot, typename Kind::Scan scan) = 0;
  virtual void TakeOdometry(const std::string& robot,
                            Timestamp stamp,
                            const typename Kind::Pose& T_odom_robot) = 0;
  /// Whether somebody publishes odometry; told again and again.
  virtual void TakeOdometryUse(const std::string& robot, bool is_published) = 0;
  /// Somebody says where the robot is in the map.
  virtual void TakeInitialPose(const std::string& robot,
                               const typename Kind::UncertainPose& map_robot) = 0;
};

using RobotListener = BasicRobotListener<team::Planar>;
using CloudRobotListener = BasicRobotListener<team::Spatial>;

}  // namespace qwsm::dds
