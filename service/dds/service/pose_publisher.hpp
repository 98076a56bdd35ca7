// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/scans/sensor_kind.hpp"

namespace qwsm::dds {

/// Tells where a robot is: pose, odometry and transform.
/// @tparam Kind of the poses: team::Planar or team::Spatial.
template <class Kind>
class PosePublisher {
 public:
  using Pose = typename Kind::Pose;

  /// Makes the writers of a robot's poses.
  /// @param transforms writer of /tf, which all robots share; outlives this.
  PosePublisher(const Participant& participant,
                const RobotNames& names,
                const Writer<wire::TFMessage>& transforms);

  /// Publishes the pose at a time.
  /// @param map_frame that the pose is in.
  void Publish(const std::string& map_frame,
               Timestamp stamp,
               const typename Kind::UncertainPose& map_robot) const;
  /// Publishes where the robot's frames lie in the map at a time.
  /// @param T_odom_robot odometry at the same time; nothing of a robot that has none.
  void PublishTransform(const std::string& map_frame,
                        Timestamp stamp,
                        const Pose& T_map_robot,
                        const std::optional<Pose>& T_odom_robot) const;

 private:
  std::string odom_frame_;
  std::string robot_frame_;
  const Writer<wire::TFMessage>& transforms_;
  Writer<wire::PoseWithCovarianceStamped> poses_;
  Writer<wire::Odometry> odometry_;
};

extern template class PosePublisher<team::Planar>;
extern template class PosePublisher<team::Spatial>;

}  // namespace qwsm::dds
