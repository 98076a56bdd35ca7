// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/team_inbox.hpp"

#include <utility>

#include "service/dds/scan_conversion.hpp"

namespace qwsm::dds {
namespace {

std::uint64_t Now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(now).count());
}

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
      others_(participant),
      static_transform_reader_(participant, kStaticTransformsTopic, Profile::kStaticTransforms),
      shared_scans_(participant, kSharedScansTopic, Profile::kSharedScans) {
  wait_set_.Add(discovery_.handle());
  wait_set_.Add(others_.handle());
  wait_set_.Add(static_transform_reader_.handle());
  wait_set_.Add(shared_scans_.handle());
  for (const std::string& robot : robots) Join(RobotNames(robot).name(), 0);
}

void TeamInbox::Deliver(std::chrono::nanoseconds timeout) {
  wait_set_.Wait(timeout);
  NoteMembers();
  ShareRobots();
  static_transform_reader_.TakeAll(
      [this](const wire::TFMessage& message) { transforms_.Take(message); });
  DeliverSharedScans();
  for (const auto& [name, robot] : robots_) robot.inbox->Deliver(transforms_, *this);
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
    publishers_.insert(robot);
    if (robots_.contains(robot)) service_.Join(robot);
  }
  for (const std::string& robot : changes.left) {
    publishers_.erase(robot);
    if (robots_.contains(robot)) service_.Lose(robot);
  }
}

// A robot is answered by one service. When that is gone, and seen to be, others find the robot.
void TeamInbox::ShareRobots() {
  others_.Update();
  if (!finds_robots_) return;
  std::vector<std::string> claimed;
  for (const auto& [name, robot] : robots_) {
    if (others_.HaveBetterClaim(name, robot.claim)) claimed.push_back(name);
  }
  for (const std::string& robot : claimed) Leave(robot);
  for (const std::string& robot : publishers_) {
    if (robots_.size() >= RobotDiscovery::kMaxRobots) return;
    if (!robots_.contains(robot) && !others_.Answer(robot)) Join(robot, Now());
  }
}

// All that have come are handed over together: the service puts them in order.
void TeamInbox::DeliverSharedScans() {
  std::vector<team::TeamScan> scans;
  const std::size_t lost_services = shared_scans_.lost_writer_count();
  shared_scans_.TakeAll([&](const wire::RelevantScan& sample) {
    const std::string_view objection = ObjectionTo(sample);
    if (objection.empty()) {
      scans.push_back(FromWire(sample));
    } else {
      refusals_.Add(kSharedScansTopic, objection);
    }
  });
  if (!scans.empty()) service_.TakeIn(std::move(scans));
  if (lost_services > std::exchange(lost_services_, lost_services)) service_.OfferTakenIn();
}

// Readers stay when a robot leaves: it may come back where it left.
void TeamInbox::Join(const std::string& robot, std::uint64_t since_ns) {
  if (robots_.contains(robot)) return;
  const Claim claim{.since_ns = since_ns, .service = participant_.guid()};
  Robot& added = robots_[robot];
  added = {.claim = claim,
           .inbox = std::make_unique<RobotInbox>(participant_, RobotNames(robot), refusals_)};
  for (const Entity::Handle handle : added.inbox->handles()) wait_set_.Add(handle);
  if (publishers_.contains(robot)) service_.Join(robot);
  // Last: who sees the topics of the answers may send scans.
  outbox_.AddRobot(robot, claim);
}

void TeamInbox::Leave(const std::string& robot) {
  const auto known = robots_.find(robot);
  for (const Entity::Handle handle : known->second.inbox->handles()) wait_set_.Remove(handle);
  robots_.erase(known);
  service_.HandOver(robot);
  outbox_.RemoveRobot(robot);
}

}  // namespace qwsm::dds
