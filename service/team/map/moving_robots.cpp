// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/moving_robots.hpp"

#include <Eigen/Core>
#include <chrono>
#include <vector>

#include "service/team/map/robot_positions.hpp"

namespace qwsm::team {
namespace {

// A body that stands for so long is a part of the place.
constexpr Timestamp kStands = std::chrono::seconds(1);

}  // namespace

void HideMovingRobots(double radius_m,
                      const Pose2& T_odom_robot,
                      MovingBodies& bodies,
                      LaserScan& scan) {
  bodies.Follow(scan, T_odom_robot);
  bodies.Place(T_odom_robot);
  std::vector<Eigen::Vector2d> moving_m;
  for (const MovingBodies::Seen& body : bodies.seen()) {
    if (body.moves || body.followed < kStands) moving_m.push_back(body.p_robot_m);
  }
  HideRobots(moving_m, radius_m, Pose2{}, scan);
}

}  // namespace qwsm::team
