// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot/robot_publisher.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <deque>
#include <string>
#include <thread>
#include <utility>

#include "service/dds/entities/writer.hpp"
#include "service/dds/wire/imu_conversion.hpp"
#include "service/dds/wire/transform_sample.hpp"
#include "service/dds/wire/wire_kind.hpp"
#include "service/team/session/deskewing.hpp"

namespace qwsm::dds {

template <class Kind>
class BasicRobotPublisher<Kind>::Topics {
 public:
  Topics(const Participant& participant, RobotNames names, OdometryUse use, ImuUse imu)
      : participant_(participant),
        names_(std::move(names)),
        odom_frame_(names_.Frame(kOdometryFrame)),
        robot_frame_(names_.Frame(kRobotFrame)),
        static_transforms_(participant, kStaticTransformsTopic, Profile::kStaticTransformsOut),
        transforms_(participant, kTransformsTopic, Profile::kTransforms),
        truth_(participant, names_.Topic(kTruthTopic), Profile::kSensorOut),
        told_poses_(participant, names_.Topic(kInitialPoseTopic), Profile::kSensorOut) {
    // Scans last: when somebody discovers them, everything else is known already.
    if (use == OdometryUse::kPublished) {
      odometry_.emplace(participant, names_.Topic(kOdometryTopic), Profile::kSensorOut);
    }
    if (imu == ImuUse::kPublished) {
      imu_.emplace(participant, names_.Topic(kImuTopic), Profile::kFastSensorOut);
    }
    scans_.emplace(participant, names_.Topic(OnWire<Kind>::kScanTopic), Profile::kSensorOut);
  }

  bool has_listener() const {
    return scans_->reader_count() > 0 && (!odometry_ || odometry_->reader_count() > 0) &&
           (!imu_ || imu_->reader_count() > 0);
  }
  bool has_pose_listener() const { return told_poses_.reader_count() > 0; }
  const RobotNames& names() const { return names_; }

  /// The frame of a sensor that sits there. Each has its own, and one that is mounted anew gets a
  /// new one: transforms and scans may overtake each other.
  const std::string& PlaceSensor(const Pose& T_robot_sensor) {
    const auto known = std::ranges::find_if(sensors_, [&](const Sensor& sensor) {
      return Kind::IsSame(sensor.T_robot_sensor, T_robot_sensor);
    });
    if (known != sensors_.end()) return known->frame;
    if (sensors_.size() == kMostSensors) sensors_.pop_front();
    std::string frame = names_.Frame(kLaserFrame);
    if (placements_++ > 0) frame += "_" + std::to_string(placements_);
    sensors_.push_back({T_robot_sensor, std::move(frame)});
    // Who listens now is to know it before the sensor's first scan comes.
    TellSensors(static_transforms_, kPatienceForMountings);
    return sensors_.back().frame;
  }

  bool Publish(const Observation& observation, const std::optional<Pose>& T_odom_end) {
    const std::string& frame = PlaceSensor(OnWire<Kind>::Mounting(observation.scan));
    if (odometry_ && observation.T_odom_robot) {
      PublishOdometry(observation.scan.stamp, *observation.T_odom_robot);
    }
    if (odometry_ && T_odom_end) PublishOdometry(team::EndOf(observation.scan), *T_odom_end);
    const typename OnWire<Kind>::Sample sample(observation.scan, frame);
    return scans_->Write(sample.sample());
  }

  void PublishImu(std::span<const ImuReading> readings) {
    for (const ImuReading& reading : readings) imu_->Write(ToWire(reading, robot_frame_));
  }

  void PublishOdometry(Timestamp stamp, const Pose& T_odom_robot) {
    odometry_->Write(OdometryOf(stamp, odom_frame_, T_odom_robot));
    transforms_.Write(
        TransformSample(stamp, odom_frame_, robot_frame_, ToWire(T_odom_robot)).sample());
  }

  void TellPose(Timestamp stamp, const typename Kind::UncertainPose& map_robot) {
    wire::PoseWithCovarianceStamped sample{};
    sample.header = HeaderOf(stamp, map_frame_);
    sample.pose.pose = ToWire(map_robot.T_a_b);
    CopyCovariance(map_robot.covariance, sample.pose.covariance);
    told_poses_.Write(sample);
  }

  void PublishTruth(Timestamp stamp, const Pose& T_world_robot) {
    truth_.Write(OdometryOf(stamp, world_frame_, T_world_robot));
  }

  /// Waits until who listens has discovered all that is published here: a reader that does not know
  /// its writer yet takes nothing of it. Who has what the writer made last says knows the others.
  bool WaitForDiscovery(std::chrono::nanoseconds timeout) const {
    return TellSensors({participant_, kStaticTransformsTopic, Profile::kStaticTransformsOut},
                       timeout);
  }
  bool WaitForAcknowledgments(std::chrono::nanoseconds timeout) {
    return dds_wait_for_acks(static_transforms_.handle(), timeout.count()) == DDS_RETCODE_OK &&
           (!odometry_ || dds_wait_for_acks(odometry_->handle(), timeout.count()) == 0) &&
           dds_wait_for_acks(scans_->handle(), timeout.count()) == DDS_RETCODE_OK;
  }

 private:
  struct Sensor {
    Pose T_robot_sensor;
    std::string frame;
  };
  static constexpr std::size_t kMostSensors = 16;  // More are mounted anew.
  static constexpr std::chrono::nanoseconds kPatienceForMountings = std::chrono::milliseconds(100);

  /// Tells where all sensors sit, in one message: of a latched topic the last one is kept for who
  /// listens later. @returns whether all who listen now have it in time.
  bool TellSensors(const Writer<wire::TFMessage>& writer, std::chrono::nanoseconds timeout) const {
    TransformSample mountings;
    for (const Sensor& sensor : sensors_) {
      mountings.Add({}, robot_frame_, sensor.frame, ToWire(sensor.T_robot_sensor));
    }
    writer.Write(mountings.sample());
    return dds_wait_for_acks(writer.handle(), timeout.count()) == DDS_RETCODE_OK;
  }

  wire::Odometry OdometryOf(Timestamp stamp, const std::string& frame, const Pose& pose) const {
    wire::Odometry sample{};
    sample.header = HeaderOf(stamp, frame);
    sample.child_frame_id = Borrow(robot_frame_);
    sample.pose.pose = ToWire(pose);
    return sample;
  }

  const Participant& participant_;
  RobotNames names_;
  std::string odom_frame_;
  std::string robot_frame_;
  std::string world_frame_ = kWorldFrame;
  std::string map_frame_ = kMapFrame;
  std::deque<Sensor> sensors_;
  int placements_ = 0;
  Writer<wire::TFMessage> static_transforms_;
  Writer<wire::TFMessage> transforms_;
  Writer<wire::Odometry> truth_;
  Writer<wire::PoseWithCovarianceStamped> told_poses_;
  std::optional<Writer<wire::Odometry>> odometry_;
  std::optional<Writer<wire::Imu>> imu_;
  std::optional<Writer<typename OnWire<Kind>::Scan>> scans_;
};

template <class Kind>
BasicRobotPublisher<Kind>::BasicRobotPublisher(const Participant& participant,
                                               RobotNames names,
                                               OdometryUse odometry,
                                               ImuUse imu)
    : topics_(std::make_unique<Topics>(participant, std::move(names), odometry, imu)) {}

template <class Kind>
BasicRobotPublisher<Kind>::~BasicRobotPublisher() = default;

template <class Kind>
bool BasicRobotPublisher<Kind>::WaitForListener(const Pose& T_robot_sensor,
                                                std::chrono::nanoseconds timeout) {
  constexpr auto kLook = std::chrono::milliseconds(5);
  topics_->PlaceSensor(T_robot_sensor);
  const auto until = std::chrono::steady_clock::now() + timeout;
  while (!topics_->has_listener()) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(kLook);
  }
  return topics_->WaitForDiscovery(until - std::chrono::steady_clock::now());
}

template <class Kind>
bool BasicRobotPublisher<Kind>::Publish(const Observation& observation,
                                        const std::optional<Pose>& T_odom_end) {
  return topics_->Publish(observation, T_odom_end);
}

template <class Kind>
void BasicRobotPublisher<Kind>::PublishImu(std::span<const ImuReading> readings) {
  topics_->PublishImu(readings);
}

template <class Kind>
bool BasicRobotPublisher<Kind>::has_listener() const {
  return topics_->has_listener();
}

template <class Kind>
bool BasicRobotPublisher<Kind>::has_pose_listener() const {
  return topics_->has_pose_listener();
}

template <class Kind>
void BasicRobotPublisher<Kind>::TellPose(Timestamp stamp,
                                         const typename Kind::UncertainPose& map_robot) {
  topics_->TellPose(stamp, map_robot);
}

template <class Kind>
void BasicRobotPublisher<Kind>::PublishTruth(Timestamp stamp, const Pose& T_world_robot) {
  topics_->PublishTruth(stamp, T_world_robot);
}

template <class Kind>
bool BasicRobotPublisher<Kind>::WaitForAcknowledgments(std::chrono::nanoseconds timeout) {
  return topics_->WaitForAcknowledgments(timeout);
}

template <class Kind>
void BasicRobotPublisher<Kind>::Finish(std::chrono::nanoseconds timeout) {
  constexpr auto kOnItsWay = std::chrono::milliseconds(200);
  WaitForAcknowledgments(timeout);
  std::this_thread::sleep_for(kOnItsWay);
}

template <class Kind>
const RobotNames& BasicRobotPublisher<Kind>::names() const {
  return topics_->names();
}

template class BasicRobotPublisher<team::Planar>;
template class BasicRobotPublisher<team::Spatial>;

}  // namespace qwsm::dds
