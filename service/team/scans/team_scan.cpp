// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/team_scan.hpp"

#include "qwsm/geometry/position.hpp"
#include "qwsm/sensor/scan_limits.hpp"
#include "service/team/scans/robot_name.hpp"

namespace qwsm::team {

std::string_view ObjectionTo(const TeamScan& scan) {
  if (!IsRobotName(scan.key.robot)) return "its robot's name is no namespace";
  if (!IsRobotName(scan.component)) return "its map's name is no namespace";
  if (scan.T_odom_robot && !IsPosition(*scan.T_odom_robot)) return "its odometry is no position";
  const std::string_view objection = ObjectionTo(scan.scan);
  return objection.empty() ? ObjectionTo(scan.map_robot) : objection;
}

}  // namespace qwsm::team
