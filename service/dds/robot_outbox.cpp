// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot_outbox.hpp"

#include "service/dds/planar.hpp"
#include "service/dds/report_conversion.hpp"

namespace qwsm::dds {

RobotOutbox::RobotOutbox(const Participant& participant,
                         const RobotNames& names,
                         const Writer<wire::TFMessage>& transforms)
    : map_frame_(kMapFrame),
      odom_frame_(names.Frame(kOdometryFrame)),
      robot_frame_(names.Frame(kRobotFrame)),
      transforms_(transforms),
      poses_(participant, names.Topic(kPoseTopic), Profile::kAnswer),
      odometry_(participant, names.Topic(kMatchedOdometryTopic), Profile::kAnswer),
      reports_(participant, names.Topic(kReportTopic), Profile::kAnswer) {}

void RobotOutbox::Publish(const team::RobotAnswer& answer) const {
  const MappingStep& step = answer.step;
  wire::PoseWithCovarianceStamped pose{};
  pose.header = HeaderOf(step.stamp, map_frame_);
  pose.pose.pose = ToWire(step.map_robot.T_a_b);
  CopyCovariance(step.map_robot.covariance, pose.pose.covariance);
  poses_.Write(pose);

  wire::Odometry odometry{};
  odometry.header = pose.header;
  odometry.child_frame_id = Borrow(robot_frame_);
  odometry.pose = pose.pose;
  odometry_.Write(odometry);

  PublishTransform(answer);
}

void RobotOutbox::Report(const team::RobotAnswer& answer) const {
  const MatchReport report = ReportOf(answer);
  reports_.Write(ToWire(report, map_frame_));
}

/// A frame has one parent only: the robot's is `odom`, which whoever measures odometry publishes.
/// Without odometry it is `map`.
void RobotOutbox::PublishTransform(const team::RobotAnswer& answer) const {
  const Pose2& T_map_robot = answer.step.map_robot.T_a_b;
  const std::optional<Pose2>& T_odom_robot = answer.T_odom_robot;
  const Pose2 T_map_child = T_odom_robot ? T_map_robot * T_odom_robot->Inverse() : T_map_robot;
  const wire::Pose pose = ToWire(T_map_child);
  wire::TransformStamped transform{};
  transform.header = HeaderOf(answer.step.stamp, map_frame_);
  transform.child_frame_id = Borrow(T_odom_robot ? odom_frame_ : robot_frame_);
  transform.transform.translation = {pose.position.x, pose.position.y, 0.0};
  transform.transform.rotation = pose.orientation;
  wire::TFMessage message{};
  message.transforms = {._maximum = 1, ._length = 1, ._buffer = &transform, ._release = false};
  transforms_.Write(message);
}

}  // namespace qwsm::dds
