// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Odometry without what it gets wrong all the time. Tyres creep while they push, on grass by a few
/// percent of the way, wheels are not quite as large as is thought, nor quite alike, and four that
/// scrub while they turn stand as far apart as the ground makes them.
///
/// Learned from where matches find the robot, by a Kalman filter of which the three states walk at
/// random with the ground that passes by.
class OdometryCalibration {
 public:
  /// The odometry of the next scan, in a frame of its own. To be asked once for each scan.
  /// @param is_turn_by_gyro then there is nothing to learn of turns, nor to correct.
  std::optional<Pose2> Follow(const std::optional<Pose2>& T_odom_robot, bool is_turn_by_gyro);

  /// Takes where the robot was found after the last motion.
  /// @param before where it was before; in the frame of the match, like `found`.
  /// @param motion as Follow() told it.
  /// @param found by what the scan alone tells.
  void Learn(const UncertainPose2& before,
             const UncertainPose2& motion,
             const UncertainPose2& found);

  /// Goes on from this reading.
  void Restart(const std::optional<Pose2>& T_odom_robot);

  /// By what share of the way that is told the robot goes less far.
  double way_error() const { return errors_(0); }
  /// By what share of the turn that is told it turns less.
  double turn_error() const { return errors_(1); }
  /// By how much less it turns over each metre ahead.
  double drift_rad_per_m() const { return errors_(2); }

 private:
  Pose2 Corrected(const Pose2& told) const;
  // Takes by how much less something was than expected. @param told how much each error makes of
  // it.
  void Update(const Eigen::Vector3d& told, double less, double variance);

  std::optional<Pose2> T_odom_last_;
  Pose2 T_corrected_;
  Pose2 told_;  // The last motion.
  bool is_turn_by_gyro_ = false;
  Eigen::Vector3d errors_ = Eigen::Vector3d::Zero();
  // Of 5 % each, as on soft ground, and of 0.02 rad/m.
  Eigen::Matrix3d covariance_ = Eigen::Vector3d(0.0025, 0.0025, 0.0004).asDiagonal();
};

}  // namespace qwsm
