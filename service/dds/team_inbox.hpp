// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "service/dds/other_services.hpp"
#include "service/dds/reader.hpp"
#include "service/dds/refusals.hpp"
#include "service/dds/robot_discovery.hpp"
#include "service/dds/robot_inbox.hpp"
#include "service/dds/static_transforms.hpp"
#include "service/dds/team_outbox.hpp"
#include "service/dds/wait_set.hpp"
#include "service/team/team_service.hpp"

namespace qwsm::dds {

/// Brings the service what robots and other services say. Used by one thread.
class TeamInbox final : private RobotListener {
 public:
  /// Joins the robots that are named; where none is, whoever publishes scans that no other service
  /// answers, now or since that service is gone.
  /// @param participant and all others outlive this.
  TeamInbox(const Participant& participant,
            const std::vector<std::string>& robots,
            team::TeamService& service,
            TeamOutbox& outbox,
            Refusals& refusals);

  /// Waits until something has arrived, or for so long, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout);

 private:
  void TakeScan(const std::string& robot, LaserScan scan) override;
  void TakeOdometry(const std::string& robot, Timestamp stamp, const Pose2& T_odom_robot) override;
  void TakeOdometryUse(const std::string& robot, bool is_published) override;
  void TakeInitialPose(const std::string& robot, const UncertainPose2& map_robot) override;

  struct Robot {
    Claim claim;
    std::unique_ptr<RobotInbox> inbox;
  };

  void NoteMembers();
  void ShareRobots();
  void DeliverSharedScans();
  void Join(const std::string& robot, std::uint64_t since_ns);
  void Leave(const std::string& robot);

  const Participant& participant_;
  team::TeamService& service_;
  TeamOutbox& outbox_;
  Refusals& refusals_;
  bool finds_robots_;
  WaitSet wait_set_;
  RobotDiscovery discovery_;
  OtherServices others_;
  Reader<wire::TFMessage> static_transform_reader_;
  StaticTransforms transforms_;
  Reader<wire::RelevantScan> shared_scans_;
  std::size_t lost_services_ = 0;
  std::set<std::string> publishers_;  // Robots whose scans are published.
  std::map<std::string, Robot> robots_;
};

}  // namespace qwsm::dds
