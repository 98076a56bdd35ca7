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

  static const Pose& MountingOf(const Scan& scan) { return scan.geometry.T_robot_laser; }
  static bool IsSame(const Pose& a, const Pose& b) { return a == b; }
};

/// Types for clouds of points in space; sessions, inboxes and publishers are made for it or for
/// Planar. A Step has the stamp of its scan and the pose map_robot.
struct Spatial {
  using Scan = CloudScan;
  using Pose = slam6d::Pose3;
  using UncertainPose = slam6d::UncertainPose3;
  using Observation = CloudObservation;
  using Step = CloudStep;

  static const Pose& MountingOf(const Scan& scan) { return scan.T_robot_sensor; }
  static bool IsSame(const Pose& a, const Pose& b) {
    return a.rotation == b.rotation && a.translation_m == b.translation_m;
  }
};

}  // namespace qwsm::team
