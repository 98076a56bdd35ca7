// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <utility>

#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::team {

/// Takes what robots say. A robot is known by its namespace, such as `robot1`, or "" for the only
/// one.
/// @tparam Kind Planar or Spatial.
template <class Kind>
class RobotListener {
 public:
  RobotListener() = default;
  RobotListener(const RobotListener&) = delete;
  RobotListener& operator=(const RobotListener&) = delete;
  virtual ~RobotListener() = default;

  /// @return false if the scan was refused.
  virtual bool TakeScan(std::string_view robot, typename Kind::Scan scan) = 0;
  /// The same, where somebody has begun to say that its sensor sits elsewhere on the robot.
  virtual bool TakeContestedScan(std::string_view robot,
                                 typename Kind::Scan scan,
                                 const typename Kind::Pose& /*T_robot_sensor_claimed*/) {
    return TakeScan(robot, std::move(scan));
  }
  virtual void TakeOdometry(std::string_view robot,
                            Timestamp stamp,
                            const typename Kind::Pose& T_odom_robot) = 0;
  /// Whether somebody publishes its odometry, told again and again: only then do scans wait for it.
  virtual void ExpectOdometry(std::string_view robot, bool expected) = 0;
  /// Somebody says where the robot is in the map.
  virtual void PlaceAt(std::string_view robot, const typename Kind::UncertainPose& map_robot) = 0;
};

}  // namespace qwsm::team
