// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/moving_bodies.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// Hides other robots in the scans of one where nobody knows where they are: bodies that move, as
/// odometry tells, and those that have not been seen to stand yet. No map is asked: what comes
/// along a corridor explains itself wherever the robot is thought to be.
/// @param radius_m readings that end so near to the middle of a body are made invalid.
void HideMovingRobots(double radius_m,
                      const Pose2& T_odom_robot,
                      MovingBodies& bodies,
                      LaserScan& scan);

}  // namespace qwsm::team
