// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/observation.hpp"
#include "service/team/scans/cloud_scan.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace qwsm::team {

/// What sessions, inboxes and publishers are made for: laser scans of a plane...
struct Planar {
  using Scan = LaserScan;
  using Pose = Pose2;
  using UncertainPose = UncertainPose2;
  using Observation = qwsm::Observation;
};

/// ...or clouds of points in space.
struct Spatial {
  using Scan = CloudScan;
  using Pose = slam6d::Pose3;
  using UncertainPose = slam6d::UncertainPose3;
  using Observation = CloudObservation;
};

}  // namespace qwsm::team
