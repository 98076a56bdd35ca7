// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>

#include "qwsm/sensor/imu_reading.hpp"
#include "service/dds/entities/participant.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::dds {

/// Whether a robot says how it moved.
enum class OdometryUse { kPublished, kNone };
/// Whether it has an inertial sensor.
enum class ImuUse { kPublished, kNone };

/// Publishes as a robot does: scans, odometry, its inertial sensor and the sensor's place on it.
/// @tparam Kind team::Planar or team::Spatial.
template <class Kind>
class BasicRobotPublisher {
 public:
  using Pose = typename Kind::Pose;
  using Observation = typename Kind::Observation;

  /// Begins to publish a robot's topics. @param participant outlives this. @throws DdsError.
  BasicRobotPublisher(const Participant& participant,
                      RobotNames names,
                      OdometryUse odometry,
                      ImuUse imu = ImuUse::kNone);
  ~BasicRobotPublisher();

  /// Waits until somebody listens to the scans, knows where the sensor is, and hears the odometry
  /// from the first one on.
  /// @returns false where nobody came in time.
  bool WaitForListener(const Pose& T_robot_sensor, std::chrono::nanoseconds timeout);

  /// Publishes a scan and its odometry, which goes first, so that it is there when its scan
  /// arrives.
  /// @param T_odom_end odometry at the last beam of a scan whose beams have times.
  /// @returns false where a listener did not take it in time.
  bool Publish(const Observation& observation, const std::optional<Pose>& T_odom_end = {});
  /// Publishes what the inertial sensor felt until after a scan, before that is published.
  /// @pre it has one.
  void PublishImu(std::span<const ImuReading> readings);
  /// Whether somebody listens to the scans.
  bool has_listener() const;
  /// Whether somebody listens to where the robot is told to be.
  bool has_pose_listener() const;
  /// Tells where the robot is, as an operator would (initialpose).
  void TellPose(Timestamp stamp, const typename Kind::UncertainPose& map_robot);
  void PublishTruth(Timestamp stamp, const Pose& T_world_robot);

  /// Waits until all that was published has arrived at every reliable listener.
  bool WaitForAcknowledgments(std::chrono::nanoseconds timeout);
  /// Waits for acknowledgments before this object goes, and a moment longer: listeners that
  /// acknowledge nothing may hear that their publisher is gone before they hear what it said last,
  /// which then is lost.
  void Finish(std::chrono::nanoseconds timeout);

  const RobotNames& names() const;

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

using RobotPublisher = BasicRobotPublisher<team::Planar>;
using CloudRobotPublisher = BasicRobotPublisher<team::Spatial>;

extern template class BasicRobotPublisher<team::Planar>;
extern template class BasicRobotPublisher<team::Spatial>;

}  // namespace qwsm::dds
