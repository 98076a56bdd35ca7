// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "service/dds/entities/wait_set.hpp"
#include "service/dds/robot/robot_discovery.hpp"
#include "service/dds/robot/robot_inbox.hpp"
#include "service/dds/service/other_services.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/dds/wire/static_transforms.hpp"

namespace qwsm::dds {

/// Brings a service what robots say, and agrees with other services of its kind on who answers
/// which robot. Used by one thread.
/// @tparam Service takes messages of robots by name: TakeScan() and so on.
/// @tparam Outbox has AddRobot() and RemoveRobot().
template <class Kind, class Service, class Outbox>
class ServiceInbox final : private BasicRobotListener<Kind> {
 public:
  /// Joins the robots that are named; where none is, whoever publishes scans that no other service
  /// answers, now or since that service is gone.
  /// @param participant and all others outlive this.
  ServiceInbox(const Participant& participant,
               const std::vector<std::string>& robots,
               Service& service,
               Outbox& outbox,
               Refusals& refusals);

  /// Waits until something has arrived, or for so long, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout) {
    Wait(timeout);
    Deliver();
  }

  /// The same in two steps, for who waits for more: see wait_set().
  void Wait(std::chrono::nanoseconds timeout) { wait_set_.Wait(timeout); }
  void Deliver();
  WaitSet& wait_set() { return wait_set_; }

 private:
  using Pose = typename Kind::Pose;

  void TakeScan(const std::string& robot, typename Kind::Scan scan) override;
  void TakeOdometry(const std::string& robot, Timestamp stamp, const Pose& T_odom_robot) override;
  void TakeOdometryUse(const std::string& robot, bool is_published) override;
  void TakeInitialPose(const std::string& robot,
                       const typename Kind::UncertainPose& map_robot) override;

  struct Robot {
    Claim claim;
    Profile profile{};
    std::unique_ptr<BasicRobotInbox<Kind>> inbox;
  };

  void NoteMembers();
  void ShareRobots();
  void Join(const std::string& robot, std::uint64_t since_ns);
  void Leave(const std::string& robot);
  void Attend(const std::string& name, Robot& robot);
  void Listen(const std::string& name, Profile profile, Robot& robot);
  void StopListening(Robot& robot);

  const Participant& participant_;
  Service& service_;
  Outbox& outbox_;
  Refusals& refusals_;
  bool finds_robots_;
  WaitSet wait_set_;
  RobotDiscovery discovery_;
  OtherServices others_;
  Reader<wire::TFMessage> static_transform_reader_;
  BasicStaticTransforms<Kind> transforms_;
  std::set<std::string> publishers_;  // Robots whose scans are published.
  std::map<std::string, Robot> robots_;
};

}  // namespace qwsm::dds
