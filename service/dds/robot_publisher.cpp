// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot_publisher.hpp"

#include <dds/dds.h>

#include <string>
#include <thread>
#include <utility>

#include "service/dds/planar.hpp"
#include "service/dds/scan_conversion.hpp"
#include "service/dds/writer.hpp"

namespace qwsm::dds {

class RobotPublisher::Topics {
 public:
  Topics(const Participant& participant, RobotNames names, OdometryUse use)
      : names_(std::move(names)),
        odom_frame_(names_.Frame(kOdometryFrame)),
        robot_frame_(names_.Frame(kRobotFrame)),
        static_transforms_(participant, kStaticTransformsTopic, Profile::kStaticTransformsOut),
        truth_(participant, names_.Topic(kTruthTopic), Profile::kSensorOut),
        told_poses_(participant, names_.Topic(kInitialPoseTopic), Profile::kSensorOut) {
    // Scans last: when somebody discovers them, everything else is known already.
    if (use == OdometryUse::kPublished) {
      odometry_.emplace(participant, names_.Topic(kOdometryTopic), Profile::kSensorOut);
    }
    scans_.emplace(participant, names_.Topic(kScanTopic), Profile::kSensorOut);
  }

  bool has_listener() const {
    return scans_->reader_count() > 0 && (!odometry_ || odometry_->reader_count() > 0);
  }
  bool has_pose_listener() const { return told_poses_.reader_count() > 0; }
  const RobotNames& names() const { return names_; }

  /// A laser that is mounted anew gets a new frame: transforms and scans may overtake each other.
  void PlaceLaser(const Pose2& T_robot_laser) {
    if (T_robot_laser_ == T_robot_laser) return;
    T_robot_laser_ = T_robot_laser;
    laser_frame_ = names_.Frame(kLaserFrame);
    if (placements_++ > 0) laser_frame_ += "_" + std::to_string(placements_);
    const wire::Pose pose = ToWire(T_robot_laser);
    wire::TransformStamped transform{};
    transform.header = HeaderOf({}, robot_frame_);
    transform.child_frame_id = Borrow(laser_frame_);
    transform.transform.translation = {pose.position.x, pose.position.y, 0.0};
    transform.transform.rotation = pose.orientation;
    wire::TFMessage message{};
    message.transforms = {._maximum = 1, ._length = 1, ._buffer = &transform, ._release = false};
    static_transforms_.Write(message);
  }

  bool Publish(const Observation& observation) {
    PlaceLaser(observation.scan.geometry.T_robot_laser);
    if (odometry_ && observation.T_odom_robot) {
      odometry_->Write(OdometryOf(observation.scan.stamp, odom_frame_, *observation.T_odom_robot));
    }
    return scans_->Write(ToWire(observation.scan, laser_frame_));
  }

  void TellPose(Timestamp stamp, const UncertainPose2& map_robot) {
    wire::PoseWithCovarianceStamped sample{};
    sample.header = HeaderOf(stamp, map_frame_);
    sample.pose.pose = ToWire(map_robot.T_a_b);
    CopyCovariance(map_robot.covariance, sample.pose.covariance);
    told_poses_.Write(sample);
  }

  void PublishTruth(Timestamp stamp, const Pose2& T_world_robot) {
    truth_.Write(OdometryOf(stamp, world_frame_, T_world_robot));
  }

  bool WaitForAcknowledgments(std::chrono::nanoseconds timeout) {
    return dds_wait_for_acks(static_transforms_.handle(), timeout.count()) == DDS_RETCODE_OK &&
           (!odometry_ || dds_wait_for_acks(odometry_->handle(), timeout.count()) == 0) &&
           dds_wait_for_acks(scans_->handle(), timeout.count()) == DDS_RETCODE_OK;
  }

 private:
  wire::Odometry OdometryOf(Timestamp stamp, const std::string& frame, const Pose2& pose) const {
    wire::Odometry sample{};
    sample.header = HeaderOf(stamp, frame);
    sample.child_frame_id = Borrow(robot_frame_);
    sample.pose.pose = ToWire(pose);
    return sample;
  }

  RobotNames names_;
  std::string odom_frame_;
  std::string robot_frame_;
  std::string world_frame_ = kWorldFrame;
  std::string map_frame_ = kMapFrame;
  std::string laser_frame_;
  std::optional<Pose2> T_robot_laser_;
  int placements_ = 0;
  Writer<wire::TFMessage> static_transforms_;
  Writer<wire::Odometry> truth_;
  Writer<wire::PoseWithCovarianceStamped> told_poses_;
  std::optional<Writer<wire::Odometry>> odometry_;
  std::optional<Writer<wire::LaserScan>> scans_;
};

RobotPublisher::RobotPublisher(const Participant& participant,
                               RobotNames names,
                               OdometryUse odometry)
    : topics_(std::make_unique<Topics>(participant, std::move(names), odometry)) {}

RobotPublisher::~RobotPublisher() = default;

bool RobotPublisher::WaitForListener(const Pose2& T_robot_laser, std::chrono::nanoseconds timeout) {
  constexpr auto kLook = std::chrono::milliseconds(5);
  topics_->PlaceLaser(T_robot_laser);
  const auto until = std::chrono::steady_clock::now() + timeout;
  while (!topics_->has_listener()) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(kLook);
  }
  return topics_->WaitForAcknowledgments(until - std::chrono::steady_clock::now());
}

bool RobotPublisher::Publish(const Observation& observation) {
  return topics_->Publish(observation);
}

bool RobotPublisher::has_listener() const { return topics_->has_listener(); }

bool RobotPublisher::has_pose_listener() const { return topics_->has_pose_listener(); }

void RobotPublisher::TellPose(Timestamp stamp, const UncertainPose2& map_robot) {
  topics_->TellPose(stamp, map_robot);
}

void RobotPublisher::PublishTruth(Timestamp stamp, const Pose2& T_world_robot) {
  topics_->PublishTruth(stamp, T_world_robot);
}

bool RobotPublisher::WaitForAcknowledgments(std::chrono::nanoseconds timeout) {
  return topics_->WaitForAcknowledgments(timeout);
}

const RobotNames& RobotPublisher::names() const { return topics_->names(); }

}  // namespace qwsm::dds
