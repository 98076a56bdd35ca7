// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/observation.hpp"

namespace qwsm {

/// A scan as if the robot had stood where it was at the first beam.
struct StillScan {
  LaserScan scan;
  /// By which its beams were moved, in the frame of the robot: m/s, m/s, rad/s. Nothing where they
  /// have no times, or odometry could have brought them to one place and has not.
  std::optional<Eigen::Vector3d> velocity{};
};

/// How the robot moves while its laser scans, beside what odometry tells: wheels slip along and
/// across their way, and tell turns badly. Scans whose beams odometry has brought to one place are
/// mended by it; those of a robot without odometry are brought to one place by it alone.
///
/// That is a velocity in the frame of the robot, learned from the poses that matches find, by a
/// Kalman filter for each of its three parts: it changes as a random walk.
class SlipEstimator {
 public:
  /// Moves the beams of a scan to one place by what is known.
  StillScan Mended(const Observation& observation) const;

  /// Takes where a scan was found to be taken, the next one after the last.
  /// @param velocity by which its beams were moved to one place before.
  void Learn(const Observation& observation,
             const std::optional<Eigen::Vector3d>& velocity,
             const MappingStep& step);

  /// The next pose does not go on from the last one: the map was corrected, or the robot moved.
  void Interrupt() { last_.reset(); }

  /// Beside what odometry tells, in the frame of the robot: m/s, m/s, rad/s.
  const Eigen::Vector3d& slip() const { return slip_.mean; }
  /// All of its motion, where there is no odometry.
  const Eigen::Vector3d& velocity() const { return velocity_.mean; }

 private:
  /// Where a scan was taken, as matched and as told.
  struct Look {
    Timestamp stamp{};
    Pose2 T_map_robot;  // Where it was in the middle of the sweep, but for what odometry tells.
    std::optional<Pose2> T_odom_robot;
    std::optional<double> gyro_rad;
    Eigen::Vector3d variances;  // Of the match, along the axes of the robot.
  };

  /// A velocity that changes as a random walk.
  struct Velocity {
    Eigen::Vector3d walk;       // Sigmas of its change in a second.
    Eigen::Vector3d variances;  // Of what is known of it.
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();

    void Learn(const Eigen::Vector3d& seen, const Eigen::Vector3d& noise, double elapsed_s);
  };

  const Velocity& UntoldOf(const Observation& observation) const {
    return observation.T_odom_robot ? slip_ : velocity_;
  }
  static std::optional<Look> LookOf(const Observation& observation,
                                    const Eigen::Vector3d& velocity,
                                    const MappingStep& step);
  void Learn(const Look& before, const Look& now, double elapsed_s);

  std::optional<Look> last_;  // Of the last scan, if that was matched.
  // A twentieth of the motion, which changes as that does. Were it more, a jump of odometry would pass
  // for slip.
  Velocity slip_{.walk = {0.03, 0.03, 0.05}, .variances = Eigen::Vector3d::Constant(0.01)};
  // As robots accelerate.
  Velocity velocity_{.walk = {0.5, 0.5, 1.0}, .variances = Eigen::Vector3d::Constant(1.0)};
};

}  // namespace qwsm
