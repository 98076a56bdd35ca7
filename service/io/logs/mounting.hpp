// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm::io {

/// Finds where a laser sits from lines that give the pose of the laser and that of the robot.
///
/// In a recording the two differ by the mounting, always the same; in a log that was corrected
/// afterwards the first is a corrected pose, and their difference drifts.
class MountingEstimator {
 public:
  /// Takes in what the two poses of one line differ by.
  void Add(const Pose2& T_odom_robot, const Pose2& T_odom_laser);

  /// The mounting, if the differences agree on a plausible one.
  std::optional<Pose2> Estimate() const;

 private:
  std::vector<Pose2> T_robot_laser_;
};

}  // namespace qwsm::io
