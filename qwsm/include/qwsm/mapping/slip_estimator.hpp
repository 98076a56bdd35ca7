// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/observation.hpp"

namespace qwsm {

/// How the robot moves beside what odometry tells: wheels slip along and across their way, and tell
/// turns badly. Scans whose beams odometry has brought to one place are mended by it.
///
/// The slip is a velocity in the frame of the robot, learned from the poses that matches find, by a
/// Kalman filter for each of its three parts: it changes as a random walk.
class SlipEstimator {
 public:
  /// The scan as if the robot had stood where it was at the first beam: odometry has put its beams
  /// there (Deskewed()), but for the slip. Other scans are left as they are.
  LaserScan Mended(LaserScan scan) const;
  /// The observation with its scan mended.
  Observation Mended(Observation observation) const;

  /// Takes where an observation was found to be taken, the next one after the last.
  void Learn(const Observation& observation, const MappingStep& step);

  /// The next pose does not go on from the last one: the map was corrected, or the robot moved.
  void Interrupt() { last_.reset(); }

  /// In the frame of the robot: m/s, m/s, rad/s.
  const Eigen::Vector3d& slip() const { return slip_; }

 private:
  /// Where a scan was taken, as matched and as told.
  struct Look {
    Timestamp stamp{};
    Pose2 T_map_robot;
    Pose2 T_odom_robot;
    std::optional<double> gyro_rad;
    Eigen::Vector3d variances;  // Of the match, along the axes of the robot.
  };

  static std::optional<Look> LookOf(const Observation& observation, const MappingStep& step);
  void Learn(const Look& before, const Look& now, double elapsed_s);

  std::optional<Look> last_;  // Of the last scan, if that was matched.
  Eigen::Vector3d slip_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d variances_ = Eigen::Vector3d::Constant(0.01);  // Of 0.1 m/s, 0.1 rad/s.
};

}  // namespace qwsm
