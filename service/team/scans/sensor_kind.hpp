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

/// Types for laser scans of a plane; sessions, inboxes and publishers are made for it or for
/// Spatial. A Step has the stamp of its scan and the pose map_robot.
struct Planar {
  using Scan = LaserScan;
  using Pose = Pose2;
  using UncertainPose = UncertainPose2;
  using Observation = qwsm::Observation;
  using Step = MappingStep;
};

/// Types for clouds of points in space; sessions, inboxes and publishers are made for it or for
/// Planar. A Step has the stamp of its scan and the pose map_robot.
struct Spatial {
  using Scan = CloudScan;
  using Pose = slam6d::Pose3;
  using UncertainPose = slam6d::UncertainPose3;
  using Observation = CloudObservation;
  using Step = CloudStep;
};

}  // namespace qwsm::team
