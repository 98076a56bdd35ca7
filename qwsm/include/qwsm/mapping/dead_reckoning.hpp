// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Where a robot would be by odometry alone since ten to twenty scans ago. Each match is near the
/// last one, as odometry has it, and may yet be a little behind every time: somebody who goes along
/// with the robot in a corridor keeps it where it is.
class DeadReckoning {
 public:
  /// @param last_robot motion since the last scan, as uncertain as odometry has proved to be.
  /// @return nothing for the first scans.
  std::optional<UncertainPose2> Predict(const UncertainPose2& last_robot) const;

  /// Goes on after a scan. @param found where the robot was found to be.
  void Follow(const UncertainPose2& last_robot, const UncertainPose2& found);
  void Clear();
  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

 private:
  // Ways that began at a pose found, this one and, ten scans later, the next one.
  std::optional<UncertainPose2> map_robot_;
  std::optional<UncertainPose2> map_robot_of_next_;
  int scans_of_next_ = 0;
};

/// Whether a pose is as far from where it is expected as chance brings once in a million cases.
bool IsFarFrom(const UncertainPose2& expected, const UncertainPose2& found);

}  // namespace qwsm
