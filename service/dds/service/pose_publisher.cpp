// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/pose_publisher.hpp"

#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/spatial.hpp"
#include "service/dds/wire/transform_sample.hpp"

namespace qwsm::dds {

template <class Kind>
PosePublisher<Kind>::PosePublisher(const Participant& participant,
                                   const RobotNames& names,
                                   const Writer<wire::TFMessage>& transforms)
    : odom_frame_(names.Frame(kOdometryFrame)),
      robot_frame_(names.Frame(kRobotFrame)),
      transforms_(transforms),
      poses_(participant, names.Topic(kPoseTopic), Profile::kAnswer),
      odometry_(participant, names.Topic(kMatchedOdometryTopic), Profile::kAnswer) {}

template <class Kind>
void PosePublisher<Kind>::Publish(const std::string& map_frame,
                                  Timestamp stamp,
                                  const typename Kind::UncertainPose& map_robot) const {
  wire::PoseWithCovarianceStamped pose{};
  pose.header = HeaderOf(stamp, map_frame);
  pose.pose.pose = ToWire(map_robot.T_a_b);
  CopyCovariance(map_robot.covariance, pose.pose.covariance);
  poses_.Write(pose);

  wire::Odometry odometry{};
  odometry.header = pose.header;
  odometry.child_frame_id = Borrow(robot_frame_);
  odometry.pose = pose.pose;
  odometry_.Write(odometry);
}

/// A frame has one parent only: the robot's is `odom`, which whoever measures odometry publishes.
/// Without odometry it is `map`.
template <class Kind>
void PosePublisher<Kind>::PublishTransform(const std::string& map_frame,
                                           Timestamp stamp,
                                           const Pose& T_map_robot,
                                           const std::optional<Pose>& T_odom_robot) const {
  const Pose T_map_child = T_odom_robot ? T_map_robot * T_odom_robot->Inverse() : T_map_robot;
  const std::string& child = T_odom_robot ? odom_frame_ : robot_frame_;
  transforms_.Write(TransformSample(stamp, map_frame, child, ToWire(T_map_child)).sample());
}

template class PosePublisher<team::Planar>;
template class PosePublisher<team::Spatial>;

}  // namespace qwsm::dds
