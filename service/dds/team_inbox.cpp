// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/team_inbox.hpp"

#include <utility>

#include "service/dds/scan_conversion.hpp"

namespace qwsm::dds {
namespace {

constexpr std::size_t kMaxRobots = 256;  // More are not a team but an attack.

}  // namespace

TeamInbox::TeamInbox(const Participant& participant,
                     const std::vector<std::string>& robots,
                     team::TeamService& service,
                     TeamOutbox& outbox,
                     Refusals& refusals)
    : participant_(participant),
      service_(service),
      outbox_(outbox),
      refusals_(refusals),
      finds_robots_(robots.empty()),
      wait_set_(participant),
      discovery_(participant, std::string(kScanTopic), kLaserScanType),
      static_transform_reader_(participant, kStaticTransformsTopic, Profile::kStaticTransforms),
      shared_scans_(participant, kSharedScansTopic, Profile::kSharedScans) {
  wait_set_.Add(discovery_.handle());
  wait_set_.Add(static_transform_reader_.handle());
  wait_set_.Add(shared_scans_.handle());
  for (const std::string& robot : robots) Join(RobotNames(robot).name());
}

void TeamInbox::Deliver(std::chrono::nanoseconds timeout) {
  wait_set_.Wait(timeout);
  NoteMembers();
  static_transform_reader_.TakeAll(
      [this](const wire::TFMessage& message) { transforms_.Take(message); });
  DeliverSharedScans();
  for (const auto& [name, robot] : robots_) robot->Deliver(transforms_, *this);
}

void TeamInbox::TakeScan(const std::string& robot, LaserScan scan) {
  service_.TakeScan(robot, std::move(scan));
}

void TeamInbox::TakeOdometry(const std::string& robot, Timestamp stamp, const Pose2& T_odom_robot) {
  service_.TakeOdometry(robot, stamp, T_odom_robot);
}

void TeamInbox::TakeOdometryUse(const std::string& robot, bool is_published) {
  service_.ExpectOdometry(robot, is_published);
}

void TeamInbox::TakeInitialPose(const std::string& robot, const UncertainPose2& map_robot) {
  service_.PlaceAt(robot, map_robot);
}

void TeamInbox::NoteMembers() {
  const RobotDiscovery::Changes changes = discovery_.Take();
  for (const std::string& robot : changes.joined) {
    if (finds_robots_ && robots_.size() < kMaxRobots) Join(robot);
    if (robots_.contains(robot)) service_.Join(robot);
  }
  for (const std::string& robot : changes.left) {
    if (robots_.contains(robot)) service_.Lose(robot);
  }
}

// All that have come are handed over together: the service puts them in order.
void TeamInbox::DeliverSharedScans() {
  std::vector<team::TeamScan> scans;
  shared_scans_.TakeAll([&](const wire::RelevantScan& sample) {
    const std::string_view objection = ObjectionTo(sample);
    if (objection.empty()) {
      scans.push_back(FromWire(sample));
    } else {
      refusals_.Add(kSharedScansTopic, objection);
    }
  });
  if (!scans.empty()) service_.TakeIn(std::move(scans));
}

// Readers stay when a robot leaves: it may come back where it left.
void TeamInbox::Join(const std::string& robot) {
  if (robots_.contains(robot)) return;
  const auto added = robots_.emplace(
      robot, std::make_unique<RobotInbox>(participant_, RobotNames(robot), refusals_));
  for (const Entity::Handle handle : added.first->second->handles()) wait_set_.Add(handle);
  outbox_.AddRobot(robot);  // Last: who sees the topics of the answers may send scans.
}

}  // namespace qwsm::dds
