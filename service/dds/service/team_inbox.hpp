// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "service/dds/service/service_inbox.hpp"
#include "service/team/service/team_service.hpp"

namespace qwsm::dds {

/// Brings the service what robots and other services say. Used by one thread.
class TeamInbox {
 public:
  /// Joins the robots as ServiceInbox does. Their scans are on the topics that the service's
  /// options name. @param participant and all others outlive this.
  TeamInbox(const Participant& participant,
            const std::vector<std::string>& robots,
            team::TeamService& service,
            std::vector<RobotTopics*> topics,
            Refusals& refusals);

  /// Waits until something has arrived, or for the timeout, and delivers it.
  void Deliver(std::chrono::nanoseconds timeout);

 private:
  void DeliverSharedScans();
  void DeliverEpochs();

  team::TeamService& service_;
  Refusals& refusals_;
  Reader<wire::RelevantScan> shared_scans_;
  Reader<wire::MapEpoch> epochs_;
  std::size_t lost_services_ = 0;
  ServiceInbox<team::RobotSession> robots_;
};

}  // namespace qwsm::dds
