// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "service/team/service/team_service.hpp"
#include "tests/support/room_drive.hpp"

/// Robots of a service in the room of ObservationInRoom().
namespace qwsm::test {

/// Of a service that drops nothing, waits for odometry, and looks for components where somebody
/// waits for that.
inline team::TeamServiceOptions LosslessOptions() {
  team::TeamServiceOptions options;
  options.merges_beside = false;
  options.team.session.queue_scans = 1000;
  options.team.session.odometry_wait_s = 10.0;
  options.team.map_period_s = 0.0;
  return options;
}

/// Gives the service so many of a robot's scans, with its odometry.
/// @param later than they are stamped in the room: who drives there after another one need not have
/// been seen by that.
inline void Give(team::TeamService& service,
                 const std::string& robot,
                 int first,
                 int count,
                 Timestamp later = {}) {
  for (int scan = first; scan < first + count; ++scan) {
    Observation observation = ObservationInRoom(scan);
    observation.scan.stamp += later;
    service.robots().TakeOdometry(robot, observation.scan.stamp, *observation.T_odom_robot);
    EXPECT_TRUE(service.robots().TakeScan(robot, observation.scan));
  }
}

inline team::RobotStatus StatusOf(const team::TeamService& service, const std::string& robot) {
  for (const team::RobotStatus& status : service.Status().robots) {
    if (status.name == robot) return status;
  }
  return {};
}

}  // namespace qwsm::test
