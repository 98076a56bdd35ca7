// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "service/dds/cloud_outbox.hpp"
#include "service/dds/refusals.hpp"
#include "service/dds/robot_discovery.hpp"
#include "service/dds/robot_inbox.hpp"
#include "service/dds/wait_set.hpp"
#include "service/team/cloud_service.hpp"

namespace qwsm::dds {

/// Brings the service for clouds what robots say. Used by one thread.
class CloudInbox final : private CloudRobotListener {
 public:
  /// Joins the robots that are named; where none is, whoever publishes clouds.
  /// @param participant and all others outlive this.
  CloudInbox(const Participant& participant,
             const std::vector<std::string>& robots,
             team::CloudService& service,
             CloudOutbox& outbox,
             Refusals& refusals);

  /// Waits until something has arrived, or for so long, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout);

 private:
  using Pose3 = slam6d::Pose3;

  void TakeScan(const std::string& robot, team::CloudScan scan) override;
  void TakeOdometry(const std::string& robot, Timestamp stamp, const Pose3& T_odom_robot) override;
  void TakeOdometryUse(const std::string& robot, bool is_published) override;
  void TakeInitialPose(const std::string& robot, const slam6d::UncertainPose3& map_robot) override;

  void NoteMembers();
  void Join(const std::string& robot);
  void Listen(const std::string& robot);

  struct Robot {
    bool is_reliable = false;
    std::unique_ptr<CloudRobotInbox> inbox;
  };

  const Participant& participant_;
  team::CloudService& service_;
  CloudOutbox& outbox_;
  Refusals& refusals_;
  bool finds_robots_;
  WaitSet wait_set_;
  RobotDiscovery discovery_;
  Reader<wire::TFMessage> static_transform_reader_;
  SpatialTransforms transforms_;
  std::map<std::string, Robot> robots_;
};

}  // namespace qwsm::dds
