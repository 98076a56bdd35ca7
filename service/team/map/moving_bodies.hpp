// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm::team {

/// Finds other robots in the scans of one where nobody knows where they are: bodies that stand
/// free, are no larger than a robot and move, as odometry tells. No map is asked: along a corridor
/// the one body that comes along is all there is to be matched with, and explains itself wherever
/// the robot is thought to be.
class MovingBodies {
 public:
  /// Takes the next scan of the robot, of any of its lasers.
  /// @return where the bodies are, in the frame of the robot, that move or have, and those of which
  /// it is not known yet; a body that stands for a while is a part of the place. None where scans
  /// are too seldom to follow one from scan to scan: nothing would ever be known to stand.
  std::vector<Eigen::Vector2d> Follow(const LaserScan& scan, const Pose2& T_odom_robot);
  /// As Follow(), and makes the readings of the scan invalid that end within the radius of a body.
  void Hide(double radius_m, const Pose2& T_odom_robot, LaserScan& scan);
  /// Odometry does not go on from the last scan.
  void Forget() {
    bodies_.clear();
    last_.reset();
  }

 private:
  struct Sighting {
    Timestamp stamp{};
    Eigen::Vector2d p_odom_m = Eigen::Vector2d::Zero();
  };
  struct Body {
    std::deque<Sighting> sightings;  // Of the last second; the newest last.
    Timestamp first_seen{};
    bool has_moved = false;
  };

  Body& BodyAt(const Sighting& seen);
  static bool Moves(const Body& body, const Eigen::Vector2d& robot_m);

  std::vector<Body> bodies_;
  std::optional<Timestamp> last_;  // Of the scan before.
};

}  // namespace qwsm::team
