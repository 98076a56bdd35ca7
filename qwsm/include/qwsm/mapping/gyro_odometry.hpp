// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/observation.hpp"

namespace qwsm {

/// Odometry whose heading is a gyro's: wheels that slip tell distances well enough, and turns
/// badly.
///
/// The gyro's bias is learned from the turns that matches find (a Kalman filter of one state), and
/// so is how good it is: it counts once its bias is known to within its noise, and while it
/// predicts turns better than the wheels do. One whose axis points down, or whose unit is wrong, is
/// left out by itself. Without a gyro odometry is returned as it is.
class GyroOdometry {
 public:
  /// The odometry of the observation, in a frame that drifts away from the wheels' as the gyro and
  /// they disagree. To be asked once for each observation.
  std::optional<Pose2> Follow(const Observation& observation);

  /// Takes the turn between the last two observations as matches found it.
  /// @param sigma_rad of that turn.
  void Learn(double turn_rad, double sigma_rad);

  /// Goes on from this reading of the wheels.
  void Restart(const std::optional<Pose2>& T_odom_robot);

  /// The wheels' reading at the last observation.
  const std::optional<Pose2>& T_wheels_robot() const { return T_wheels_last_; }
  /// Whether the last motion's heading is the gyro's.
  bool leads() const { return leads_; }
  double bias_rad_s() const { return bias_rad_s_; }

 private:
  /// What both told of the last motion.
  struct Turn {
    double by_wheels_rad = 0.0;
    double by_gyro_rad = 0.0;
    double duration_s = 0.0;
  };

  std::optional<Turn> TurnSince(const Observation& observation) const;
  // Whether the bias errs by less than noise does in a turn of that duration.
  bool IsBiasKnown(double duration_s) const;

  std::optional<Pose2> T_wheels_last_;
  std::optional<double> gyro_last_rad_;
  Timestamp stamp_last_{};
  Pose2 T_odom_robot_;
  std::optional<Turn> turn_;
  bool leads_ = false;
  double bias_rad_s_ = 0.0;
  double bias_variance_ = 0.0025;  // Of (0.05 rad/s)^2, as cheap ones have.
  int learned_ = 0;                // Turns.
  double wheels_chi2_ = 0.0;       // Mean squares of late, in units of what matches cannot tell.
  double gyro_chi2_ = 0.0;
};

}  // namespace qwsm
