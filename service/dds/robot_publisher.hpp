// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "qwsm/mapping/observation.hpp"
#include "service/dds/participant.hpp"
#include "service/dds/robot_names.hpp"

namespace qwsm::dds {

/// Whether a robot says how it moved.
enum class OdometryUse { kPublished, kNone };

/// Publishes as a robot does: scans, odometry and the laser's place on it.
class RobotPublisher {
 public:
  /// @throws DdsError.
  RobotPublisher(const Participant& participant, RobotNames names, OdometryUse odometry);
  ~RobotPublisher();

  /// Waits until somebody listens to the scans, knows where the laser is, and hears the odometry.
  /// @returns false where nobody came in time.
  bool WaitForListener(const Pose2& T_robot_laser, std::chrono::nanoseconds timeout);

  /// Odometry goes first, so that it is there when its scan arrives.
  /// @returns false where a listener did not take it in time.
  bool Publish(const Observation& observation);
  /// Whether somebody listens to the scans; to where the robot is told to be.
  bool has_listener() const;
  bool has_pose_listener() const;
  /// Tells where the robot is, as an operator would (initialpose).
  void TellPose(Timestamp stamp, const UncertainPose2& map_robot);
  void PublishTruth(Timestamp stamp, const Pose2& T_world_robot);

  /// Waits until all that was published has arrived at every reliable listener.
  bool WaitForAcknowledgments(std::chrono::nanoseconds timeout);

  const RobotNames& names() const;

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace qwsm::dds
