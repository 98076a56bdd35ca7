// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// Finds out whether scans turn the other way than odometry: a laser that is upside down, or whose
/// beams are counted from the wrong side, shows the world in a mirror.
///
/// Where the robot turns, the ranges of one scan should be found in the next by so many beams to
/// one side; each such pair of scans votes for this side or the other. O(beams) per scan.
class TurnCheck {
 public:
  /// Takes the next scan, of any laser of the robot, in the order of time.
  void Add(const LaserScan& scan, const std::optional<Pose2>& T_odom_robot);

  /// Whether scans turn against odometry, by a clear majority of many votes.
  bool turns_against_odometry() const;

 private:
  struct View {
    LaserScan scan;
    Pose2 T_odom_robot;
  };

  /// @param shift beams by which readings should have moved.
  void Vote(const LaserScan& before, const LaserScan& now, long shift);

  std::vector<View> views_;  // Of each laser, where it turned last.
  std::size_t votes_with_ = 0;
  std::size_t votes_against_ = 0;
};

}  // namespace qwsm
