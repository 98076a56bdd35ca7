// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "service/dds/entities/wait_set.hpp"
#include "service/dds/robot/mounting_reader.hpp"
#include "service/dds/robot/robot_discovery.hpp"
#include "service/dds/robot/robot_inbox.hpp"
#include "service/dds/service/other_services.hpp"
#include "service/dds/service/robot_topics.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/team/service/robot_session.hpp"
#include "service/team/session/session_list.hpp"

namespace qwsm::dds {

/// Brings a service what robots say, and agrees with other services of its kind on who answers
/// which robot. Used by one thread.
/// @tparam Session team::RobotSession, or team::CloudSession: see CloudInbox.
template <class Session>
class ServiceInbox {
 public:
  /// Joins the robots that are named; where none is, whoever publishes scans that no other service
  /// answers, now or since that service is gone.
  /// @param scan_topics of each robot, below its namespace.
  /// @param topics where each of the robots is told about.
  /// @param participant and all others outlive this.
  ServiceInbox(const Participant& participant,
               const std::vector<std::string>& robots,
               std::vector<std::string> scan_topics,
               team::SessionList<Session>& sessions,
               std::vector<RobotTopics*> topics,
               Refusals& refusals);

  /// Waits until something has arrived, or for the timeout, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout) {
    Wait(timeout);
    Deliver();
  }

  /// Waits until something has arrived, or for the timeout: the first half of Deliver(), for who
  /// waits for more, see wait_set().
  void Wait(std::chrono::nanoseconds timeout);
  void Deliver();
  WaitSet& wait_set() { return wait_set_; }

 private:
  using Kind = typename Session::Kind;

  struct Robot {
    Claim claim;
    Profile profile{};
    std::unique_ptr<BasicRobotInbox<Kind>> inbox;
    bool has_news = false;  // Whether something of it has arrived.
  };
  using Clock = std::chrono::steady_clock;

  static std::uint64_t NanosecondsNow();

  bool NoteMembers();
  void ShareRobots();
  std::vector<BasicRobotInbox<Kind>*> TakeDue();
  void Join(const std::string& robot, std::uint64_t since_ns);
  void TellOfTooMany(const std::string& robot);
  void Leave(const std::string& robot);
  void Attend(const std::string& name, Robot& robot);
  void Listen(const std::string& name, Profile profile, Robot& robot);
  void StopListening(Robot& robot);

  const Participant& participant_;
  team::SessionList<Session>& sessions_;
  std::vector<std::string> scan_topics_;
  std::vector<RobotTopics*> topics_;
  Refusals& refusals_;
  bool finds_robots_;
  WaitSet wait_set_;
  RobotDiscovery discovery_;
  OtherServices others_;
  BasicMountingReader<Kind> mountings_;
  std::set<std::string> publishers_;  // Robots whose scans are published.
  bool are_too_many_told_ = false;
  std::map<std::string, Robot> robots_;
  std::map<Entity::Handle, Robot*> robot_of_;  // By reader.
  Clock::time_point all_heard_at_{};           // When all robots were listened to.
};

extern template class ServiceInbox<team::RobotSession>;

}  // namespace qwsm::dds
