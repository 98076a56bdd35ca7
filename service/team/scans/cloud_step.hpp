// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "service/team/scans/cloud_scan.hpp"
#include "slam6d/mapping/slam.hpp"

namespace qwsm::team {

/// What the registration of one 3D scan came to.
struct CloudStep {
  Timestamp stamp{};                 ///< Of the scan.
  slam6d::UncertainPose3 map_robot;  ///< Where the scan says the robot is.
  std::shared_ptr<const CloudScan> scan;
  slam6d::Pose3 T_odom_sensor;    ///< The estimate that the registration began with.
  slam6d::SlamStep registration;  ///< Of the sensor's pose.
};

}  // namespace qwsm::team
