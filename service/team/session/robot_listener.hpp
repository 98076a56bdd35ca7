// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>

#include "qwsm/sensor/imu_reading.hpp"
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

  /// Tells that so many scans come now that have waited for where their sensor sits: that many came
  /// at once is not that more come than can be matched.
  virtual void ExpectWaited(std::string_view /*robot*/, std::size_t /*scans*/) {}
  /// Takes a scan. @return false if it was refused.
  virtual bool TakeScan(std::string_view robot, typename Kind::Scan scan) = 0;
  /// Takes a scan where somebody has begun to say that its sensor sits elsewhere on the robot.
  /// @return false if it was refused.
  virtual bool TakeContestedScan(std::string_view robot,
                                 typename Kind::Scan scan,
                                 const typename Kind::Pose& /*T_robot_sensor_claimed*/) {
    return TakeScan(robot, std::move(scan));
  }
  virtual void TakeOdometry(std::string_view robot,
                            Timestamp stamp,
                            const typename Kind::Pose& T_odom_robot) = 0;
  /// Tells, again and again, whether somebody publishes the robot's odometry: only then do scans
  /// wait for it.
  virtual void ExpectOdometry(std::string_view robot, bool expected) = 0;
  /// Takes a reading of the robot's inertial sensor, about the robot's axes. Not all sensors need
  /// it.
  virtual void TakeImu(std::string_view /*robot*/, const ImuReading& /*reading*/) {}
  /// Tells, again and again, whether somebody publishes such readings; see ExpectOdometry().
  virtual void ExpectImu(std::string_view /*robot*/, bool /*expected*/) {}
  /// Takes somebody's word on where the robot is in the map.
  virtual void PlaceAt(std::string_view robot, const typename Kind::UncertainPose& map_robot) = 0;
};

}  // namespace qwsm::team
