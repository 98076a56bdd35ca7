// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/service_inbox.hpp"

#include <utility>

#include "service/dds/service/cloud_inbox.hpp"
#include "service/dds/service/team_inbox.hpp"
#include "service/dds/wire/wire_kind.hpp"

namespace qwsm::dds {
namespace {

std::uint64_t NanosecondsNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(now).count());
}

}  // namespace

template <class Kind, class Service, class Outbox>
ServiceInbox<Kind, Service, Outbox>::ServiceInbox(const Participant& participant,
                                                  const std::vector<std::string>& robots,
                                                  Service& service,
                                                  Outbox& outbox,
                                                  Refusals& refusals)
    : participant_(participant),
      service_(service),
      outbox_(outbox),
      refusals_(refusals),
      finds_robots_(robots.empty()),
      wait_set_(participant),
      discovery_(participant, std::string(OnWire<Kind>::kScanTopic), OnWire<Kind>::kScanType),
      others_(participant, OnWire<Kind>::kReportTopic, OnWire<Kind>::kReportType),
      static_transform_reader_(participant, kStaticTransformsTopic, Profile::kStaticTransforms) {
  wait_set_.Add(discovery_.handle());
  wait_set_.Add(others_.handle());
  wait_set_.Add(static_transform_reader_.handle());
  for (const std::string& robot : robots) Join(RobotNames(robot).name(), 0);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::Deliver() {
  NoteMembers();
  ShareRobots();
  static_transform_reader_.TakeAll(
      [this](const wire::TFMessage& message) { transforms_.Take(message); });
  for (const auto& [name, robot] : robots_) robot.inbox->Deliver(transforms_, *this);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::TakeScan(const std::string& robot,
                                                   typename Kind::Scan scan) {
  service_.TakeScan(robot, std::move(scan));
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::TakeOdometry(const std::string& robot,
                                                       Timestamp stamp,
                                                       const Pose& T_odom_robot) {
  service_.TakeOdometry(robot, stamp, T_odom_robot);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::TakeOdometryUse(const std::string& robot,
                                                          bool is_published) {
  service_.ExpectOdometry(robot, is_published);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::TakeInitialPose(
    const std::string& robot, const typename Kind::UncertainPose& map_robot) {
  service_.PlaceAt(robot, map_robot);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::NoteMembers() {
  const RobotDiscovery::Changes changes = discovery_.Take();
  for (const std::string& name : changes.joined) {
    publishers_.insert(name);
    if (const auto robot = robots_.find(name); robot != robots_.end()) Attend(name, robot->second);
  }
  for (const std::string& name : changes.left) {
    publishers_.erase(name);
    if (robots_.contains(name)) service_.Lose(name);
  }
}

// A robot is answered by one service. When that is gone, and seen to be, others find the robot.
template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::ShareRobots() {
  others_.Update();
  if (!finds_robots_) return;
  std::vector<std::string> claimed;
  for (const auto& [name, robot] : robots_) {
    if (others_.HaveBetterClaim(name, robot.claim)) claimed.push_back(name);
  }
  for (const std::string& robot : claimed) Leave(robot);
  for (const std::string& robot : publishers_) {
    if (robots_.size() >= RobotDiscovery::kMaxRobots) return;
    if (!robots_.contains(robot) && !others_.Answer(robot)) Join(robot, NanosecondsNow());
  }
}

// Readers stay when a robot leaves: it may come back where it left.
template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::Join(const std::string& name, std::uint64_t since_ns) {
  if (robots_.contains(name)) return;
  const Claim claim{.since_ns = since_ns, .service = participant_.guid()};
  Robot& robot = robots_[name];
  robot.claim = claim;
  Attend(name, robot);
  // Last: who sees the topics of the answers may send scans.
  outbox_.AddRobot(name, claim);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::Leave(const std::string& name) {
  const auto known = robots_.find(name);
  StopListening(known->second);
  robots_.erase(known);
  service_.HandOver(name);
  outbox_.RemoveRobot(name);
}

// The robot is listened to as its publishers send.
template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::Attend(const std::string& name, Robot& robot) {
  const Profile profile = OnWire<Kind>::ScansIn(discovery_.IsReliable(name));
  if (!robot.inbox || profile != robot.profile) Listen(name, profile, robot);
  if (publishers_.contains(name)) service_.Join(name);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::Listen(const std::string& name,
                                                 Profile profile,
                                                 Robot& robot) {
  if (robot.inbox) StopListening(robot);
  robot.profile = profile;
  robot.inbox =
      std::make_unique<BasicRobotInbox<Kind>>(participant_, RobotNames(name), refusals_, profile);
  for (const Entity::Handle handle : robot.inbox->handles()) wait_set_.Add(handle);
}

template <class Kind, class Service, class Outbox>
void ServiceInbox<Kind, Service, Outbox>::StopListening(Robot& robot) {
  for (const Entity::Handle handle : robot.inbox->handles()) wait_set_.Remove(handle);
  robot.inbox.reset();
}

template class ServiceInbox<team::Planar, team::TeamService, TeamOutbox>;
template class ServiceInbox<team::Spatial, team::CloudService, CloudOutbox>;

}  // namespace qwsm::dds
