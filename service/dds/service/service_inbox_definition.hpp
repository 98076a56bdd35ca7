// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// How ServiceInbox works, for the two sources that make one of it: each is in the library of its
// service, so that who is no service for clouds links none.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "service/dds/service/service_inbox.hpp"
#include "service/dds/wire/wire_kind.hpp"
#include "service/team/scans/robot_name.hpp"

namespace qwsm::dds {

constexpr std::chrono::milliseconds kRoundPeriod(100);

template <class Session>
std::uint64_t ServiceInbox<Session>::NanosecondsNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::nanoseconds(now).count());
}

template <class Session>
ServiceInbox<Session>::ServiceInbox(const Participant& participant,
                                    const std::vector<std::string>& robots,
                                    std::vector<std::string> scan_topics,
                                    team::SessionList<Session>& sessions,
                                    std::vector<RobotTopics*> topics,
                                    Refusals& refusals)
    : participant_(participant),
      sessions_(sessions),
      scan_topics_(std::move(scan_topics)),
      topics_(std::move(topics)),
      refusals_(refusals),
      finds_robots_(robots.empty()),
      wait_set_(participant),
      discovery_(participant, scan_topics_, OnWire<Kind>::kScanType),
      others_(participant, OnWire<Kind>::kReportTopic, OnWire<Kind>::kReportType),
      mountings_(participant, refusals) {
  wait_set_.Add(discovery_.handle());
  wait_set_.Add(others_.handle());
  wait_set_.Add(mountings_.handle());
  for (const std::string& robot : robots) Join(RobotNames(robot).name(), 0);
}

template <class Session>
void ServiceInbox<Session>::Wait(std::chrono::nanoseconds timeout) {
  for (const Entity::Handle reader : wait_set_.Wait(timeout)) {
    if (const auto robot = robot_of_.find(reader); robot != robot_of_.end()) {
      robot->second->has_news = true;
    }
  }
}

template <class Session>
void ServiceInbox<Session>::Deliver() {
  const bool have_members_changed = NoteMembers();
  const bool have_others_changed = others_.Update();
  if (have_members_changed || have_others_changed) ShareRobots();
  const std::vector<BasicRobotInbox<Kind>*> due = TakeDue();
  for (BasicRobotInbox<Kind>* inbox : due) inbox->HoldScans();
  mountings_.Take();
  for (BasicRobotInbox<Kind>* inbox : due) inbox->Deliver(mountings_.transforms(), sessions_);
}

// The robots to listen to: a large team would keep this thread busy if each message had all of its
// robots asked. Now and then all are, for nothing arrives from publishers that come or go.
template <class Session>
std::vector<BasicRobotInbox<typename Session::Kind>*> ServiceInbox<Session>::TakeDue() {
  const Clock::time_point now = Clock::now();
  const bool are_all = now - all_heard_at_ >= kRoundPeriod;
  if (are_all) all_heard_at_ = now;
  std::vector<BasicRobotInbox<Kind>*> due;
  for (auto& [name, robot] : robots_) {
    const bool has_news = std::exchange(robot.has_news, false);
    if (has_news || are_all || robot.inbox->is_waiting()) due.push_back(robot.inbox.get());
  }
  return due;
}

/// @returns whether there are others than before.
template <class Session>
bool ServiceInbox<Session>::NoteMembers() {
  const RobotDiscovery::Changes changes = discovery_.Take();
  for (const std::string& name : changes.left) {
    publishers_.erase(name);
    if (robots_.contains(name)) sessions_.Lose(name);
  }
  for (const std::string& name : changes.joined) {
    publishers_.insert(name);
    if (const auto robot = robots_.find(name); robot != robots_.end()) Attend(name, robot->second);
  }
  return !changes.joined.empty() || !changes.left.empty();
}

// A robot is answered by one service. When that is gone, and seen to be, others find the robot.
template <class Session>
void ServiceInbox<Session>::ShareRobots() {
  if (!finds_robots_) return;
  std::vector<std::string> claimed;
  for (const auto& [name, robot] : robots_) {
    if (others_.HaveBetterClaim(name, robot.claim)) claimed.push_back(name);
  }
  for (const std::string& robot : claimed) Leave(robot);
  for (const std::string& robot : publishers_) {
    if (robots_.contains(robot) || others_.Answer(robot)) continue;
    if (robots_.size() >= team::kMaxRobots) return TellOfTooMany(robot);
    Join(robot, NanosecondsNow());
  }
}

template <class Session>
void ServiceInbox<Session>::TellOfTooMany(const std::string& robot) {
  if (std::exchange(are_too_many_told_, true)) return;
  refusals_.Tell("/" + robot + " is not answered, nor who comes later: there were " +
                 std::to_string(team::kMaxRobots) +
                 " robots already, each of which may come back; a service that is started anew has "
                 "room again");
}

// Readers stay when a robot leaves: it may come back where it left.
template <class Session>
void ServiceInbox<Session>::Join(const std::string& name, std::uint64_t since_ns) {
  if (robots_.contains(name)) return;
  const Claim claim{.since_ns = since_ns, .service = participant_.guid()};
  Robot& robot = robots_[name];
  robot.claim = claim;
  Attend(name, robot);
  // Last: who sees the topics of the answers may send scans.
  for (RobotTopics* topics : topics_) topics->AddRobot(name, claim);
}

template <class Session>
void ServiceInbox<Session>::Leave(const std::string& name) {
  const auto known = robots_.find(name);
  StopListening(known->second);
  robots_.erase(known);
  sessions_.HandOver(name);
  for (RobotTopics* topics : topics_) topics->RemoveRobot(name);
}

// The robot is listened to as its publishers send.
template <class Session>
void ServiceInbox<Session>::Attend(const std::string& name, Robot& robot) {
  const Profile profile = OnWire<Kind>::ScansIn(discovery_.IsReliable(name));
  if (!robot.inbox || profile != robot.profile) Listen(name, profile, robot);
  if (publishers_.contains(name)) sessions_.Join(name);
}

template <class Session>
void ServiceInbox<Session>::Listen(const std::string& name, Profile profile, Robot& robot) {
  if (robot.inbox) StopListening(robot);
  robot.profile = profile;
  robot.inbox = std::make_unique<BasicRobotInbox<Kind>>(
      participant_, RobotNames(name), refusals_, scan_topics_, profile);
  for (const Entity::Handle handle : robot.inbox->handles()) {
    wait_set_.Add(handle);
    robot_of_[handle] = &robot;
  }
}

template <class Session>
void ServiceInbox<Session>::StopListening(Robot& robot) {
  for (const Entity::Handle handle : robot.inbox->handles()) {
    wait_set_.Remove(handle);
    robot_of_.erase(handle);
  }
  robot.inbox.reset();
}

}  // namespace qwsm::dds
