// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/cloud_inbox.hpp"

#include <utility>

namespace qwsm::dds {

CloudInbox::CloudInbox(const Participant& participant,
                       const std::vector<std::string>& robots,
                       team::CloudService& service,
                       CloudOutbox& outbox,
                       Refusals& refusals)
    : participant_(participant),
      service_(service),
      outbox_(outbox),
      refusals_(refusals),
      finds_robots_(robots.empty()),
      wait_set_(participant),
      discovery_(participant, std::string(kCloudTopic), kPointCloudType),
      static_transform_reader_(participant, kStaticTransformsTopic, Profile::kStaticTransforms) {
  wait_set_.Add(discovery_.handle());
  wait_set_.Add(static_transform_reader_.handle());
  for (const std::string& robot : robots) Join(RobotNames(robot).name());
}

void CloudInbox::Deliver(std::chrono::nanoseconds timeout) {
  wait_set_.Wait(timeout);
  NoteMembers();
  static_transform_reader_.TakeAll(
      [this](const wire::TFMessage& message) { transforms_.Take(message); });
  for (const auto& [name, robot] : robots_) robot.inbox->Deliver(transforms_, *this);
}

void CloudInbox::TakeScan(const std::string& robot, team::CloudScan scan) {
  const std::string_view objection = team::ObjectionTo(scan);
  if (!objection.empty()) refusals_.Add(RobotNames(robot).Topic(kCloudTopic), objection);
  service_.robots().TakeScan(robot, std::move(scan));
}

void CloudInbox::TakeOdometry(const std::string& robot,
                              Timestamp stamp,
                              const Pose3& T_odom_robot) {
  service_.robots().TakeOdometry(robot, stamp, T_odom_robot);
}

void CloudInbox::TakeOdometryUse(const std::string& robot, bool is_published) {
  service_.robots().ExpectOdometry(robot, is_published);
}

void CloudInbox::TakeInitialPose(const std::string& robot,
                                 const slam6d::UncertainPose3& map_robot) {
  service_.robots().PlaceAt(robot, map_robot);
}

void CloudInbox::NoteMembers() {
  const RobotDiscovery::Changes changes = discovery_.Take();
  for (const std::string& robot : changes.joined) {
    const bool is_wanted =
        robots_.contains(robot) || (finds_robots_ && robots_.size() < RobotDiscovery::kMaxRobots);
    if (!is_wanted) continue;
    Join(robot);
    service_.robots().Join(robot);
  }
  for (const std::string& robot : changes.left) {
    if (robots_.contains(robot)) service_.robots().Lose(robot);
  }
}

// Readers stay when a robot leaves: it may come back.
void CloudInbox::Join(const std::string& robot) {
  const auto known = robots_.find(robot);
  if (known != robots_.end() && known->second.is_reliable == discovery_.IsReliable(robot)) return;
  Listen(robot);
  outbox_.AddRobot(robot);  // Last: who sees the topics of the answers may send scans.
}

// A cloud is a thousand packets: where the publisher repeats lost ones it is asked to, and one that
// does not is heard all the same.
void CloudInbox::Listen(const std::string& robot) {
  Robot& heard = robots_[robot];
  if (heard.inbox) {
    for (const Entity::Handle handle : heard.inbox->handles()) wait_set_.Remove(handle);
  }
  heard.is_reliable = discovery_.IsReliable(robot);
  const Profile profile = heard.is_reliable ? Profile::kSensorInWhole : Profile::kSensorIn;
  heard.inbox =
      std::make_unique<CloudRobotInbox>(participant_, RobotNames(robot), refusals_, profile);
  for (const Entity::Handle handle : heard.inbox->handles()) wait_set_.Add(handle);
}

}  // namespace qwsm::dds
