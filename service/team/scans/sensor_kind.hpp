// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/observation.hpp"
#include "service/team/scans/cloud_scan.hpp"
#include "service/team/scans/cloud_step.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace qwsm::team {

/// What sessions, inboxes and publishers are made for: laser scans of a plane...
struct Planar {
  using Scan = LaserScan;
  using Pose = Pose2;
  using UncertainPose = UncertainPose2;
  using Observation = qwsm::Observation;
  using Step = MappingStep;
};

/// ...or clouds of points in space. What a step of either kind has: the stamp of its scan and the
/// pose map_robot.
struct Spatial {
  using Scan = CloudScan;
  using Pose = slam6d::Pose3;
  using UncertainPose = slam6d::UncertainPose3;
  using Observation = CloudObservation;
  using Step = CloudStep;
};

}  // namespace qwsm::team
