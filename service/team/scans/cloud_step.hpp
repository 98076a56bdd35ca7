// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "service/team/scans/cloud_scan.hpp"
#include "slam6d/mapping/slam.hpp"

namespace qwsm::team {

/// The outcome of the registration of one 3D scan.
struct CloudStep {
  Timestamp stamp{};                 ///< Stamp of the scan.
  slam6d::UncertainPose3 map_robot;  ///< Where the scan says the robot is.
  std::shared_ptr<const CloudScan> scan;
  slam6d::Pose3 T_odom_sensor;    ///< Estimate that the registration began with.
  slam6d::SlamStep registration;  ///< The registration of the sensor's pose.
};

}  // namespace qwsm::team
