// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/robot_inbox.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include "service/dds/planar.hpp"
#include "service/dds/scan_conversion.hpp"
#include "service/team/team_scan.hpp"

namespace qwsm::dds {
namespace {

// A transform that is not there after this long will not come.
constexpr auto kPatienceForTransforms = std::chrono::seconds(1);
constexpr std::size_t kMaxUnplaced = 64;
constexpr std::size_t kMaxFrameLength = 256;

std::string_view ObjectionTo(const wire::Header& header, const wire::Pose& pose) {
  if (!FromWire(header.stamp)) return "its stamp is no time";
  if (!std::isfinite(UprightnessOf(pose.orientation))) return "its orientation is no rotation";
  if (!IsFinite(FromWire(pose))) return "its pose is not finite";
  return {};
}

}  // namespace

RobotInbox::RobotInbox(const Participant& participant, const RobotNames& names, Refusals& refusals)
    : names_(names),
      refusals_(refusals),
      robot_frame_(names.Frame(kRobotFrame)),
      odometry_(participant, names.Topic(kOdometryTopic), Profile::kSensorIn),
      scans_(participant, names.Topic(kScanTopic), Profile::kSensorIn),
      initial_poses_(participant, names.Topic(kInitialPoseTopic), Profile::kSensorIn) {}

std::array<Entity::Handle, 3> RobotInbox::handles() const {
  return {odometry_.handle(), scans_.handle(), initial_poses_.handle()};
}

void RobotInbox::Deliver(const StaticTransforms& transforms, RobotListener& listener) {
  listener.TakeOdometryUse(names_.name(), odometry_.writer_count() > 0);
  odometry_.TakeAll([&](const wire::Odometry& sample) { TakeOdometry(sample, listener); });
  initial_poses_.TakeAll(
      [&](const wire::PoseWithCovarianceStamped& sample) { TakeInitialPose(sample, listener); });
  scans_.TakeAll([this](const wire::LaserScan& sample) { TakeScan(sample); });
  DeliverPlacedScans(transforms, listener);
}

void RobotInbox::TakeOdometry(const wire::Odometry& sample, RobotListener& listener) {
  const std::string_view objection = ObjectionTo(sample.header, sample.pose.pose);
  if (!objection.empty()) return refusals_.Add(names_.Topic(kOdometryTopic), objection);
  const std::size_t length = strnlen(sample.child_frame_id, kMaxFrameLength + 1);
  if (length > 0 && length <= kMaxFrameLength) robot_frame_ = sample.child_frame_id;
  listener.TakeOdometry(names_.name(), *FromWire(sample.header.stamp), FromWire(sample.pose.pose));
}

void RobotInbox::TakeScan(const wire::LaserScan& sample) {
  const std::string topic = names_.Topic(kScanTopic);
  const std::string_view objection = ObjectionTo(sample);
  if (!objection.empty()) return refusals_.Add(topic, objection);
  unplaced_.push_back({.scan = FromWire(sample, Pose2{}), .laser_frame = sample.header.frame_id});
  if (unplaced_.size() <= kMaxUnplaced) return;
  unplaced_.pop_front();
  refusals_.Add(topic, "/tf_static does not say yet where on the robot its frame is");
}

// Scans and /tf_static overtake each other at the beginning.
void RobotInbox::DeliverPlacedScans(const StaticTransforms& transforms, RobotListener& listener) {
  while (!unplaced_.empty()) {
    UnplacedScan& first = unplaced_.front();
    const std::optional<Pose2> T_robot_laser = LaserOnRobot(first.laser_frame, transforms);
    if (!T_robot_laser) return;
    first.scan.geometry.T_robot_laser = *T_robot_laser;
    listener.TakeScan(names_.name(), std::move(first.scan));
    unplaced_.pop_front();
  }
}

void RobotInbox::TakeInitialPose(const wire::PoseWithCovarianceStamped& sample,
                                 RobotListener& listener) {
  const UncertainPose2 map_robot{.T_a_b = FromWire(sample.pose.pose),
                                 .covariance = PlanarCovariance(sample.pose.covariance)};
  std::string_view objection = ObjectionTo(sample.header, sample.pose.pose);
  if (objection.empty()) objection = team::ObjectionTo(map_robot);
  if (!objection.empty()) return refusals_.Add(names_.Topic(kInitialPoseTopic), objection);
  listener.TakeInitialPose(names_.name(), map_robot);
}

/// A laser nobody says anything about sits in the middle of the robot.
std::optional<Pose2> RobotInbox::LaserOnRobot(const std::string& laser_frame,
                                              const StaticTransforms& transforms) {
  if (const auto known = transforms.Find(robot_frame_, laser_frame)) {
    unplaced_since_.reset();
    return known;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!unplaced_since_) unplaced_since_ = now;
  return now - *unplaced_since_ < kPatienceForTransforms ? std::nullopt : std::optional(Pose2{});
}

}  // namespace qwsm::dds
