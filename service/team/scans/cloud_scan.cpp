// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/cloud_scan.hpp"

#include "slam6d/geometry/position.hpp"

namespace qwsm::team {

std::string_view ObjectionTo(const CloudScan& scan) {
  if (scan.cloud.empty()) return "the cloud has no points";
  if (scan.cloud.size() > kMaxCloudPoints) return "the cloud has more than 20 million points";
  if (!IsPosition(scan.T_robot_sensor)) return "the sensor's mounting is not finite, or absurd";
  return {};
}

}  // namespace qwsm::team
