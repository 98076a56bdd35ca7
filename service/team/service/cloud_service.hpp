// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "service/team/service/cloud_options.hpp"
#include "service/team/service/cloud_session.hpp"
#include "service/team/service/session_host.hpp"
#include "service/team/sinks/cloud_sink.hpp"

namespace qwsm::team {

struct CloudServiceOptions {
  CloudTeamOptions team;
  slam6d::SlamOptions slam;
};

/// 6D SLAM for robots on the network: takes their clouds and odometry, answers each cloud with a
/// pose, and keeps a model for each robot.
///
/// All functions may be called from any thread, but not from the sinks.
class CloudService {
 public:
  /// Opens the journal; the models begin with the scans in it.
  /// @param closer outlives this.
  /// @param journal where scans are kept; empty: nowhere.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  CloudService(const CloudServiceOptions& options,
               const slam6d::LoopCloser& closer,
               SinkList<CloudSink> sinks,
               const std::filesystem::path& journal = {});
  /// Stops as Stop() does.
  ~CloudService();
  CloudService(const CloudService&) = delete;
  CloudService& operator=(const CloudService&) = delete;

  /// Starts to work: first on the scans of the journal. What arrives before waits.
  void Start();
  /// Finishes the registrations at work and works no more. What waits in queues is left out.
  void Stop() { host_.Stop(); }
  /// Waits until every scan that was taken is answered or dropped, and all that can be is on disk.
  void WaitUntilIdle() { host_.WaitUntilIdle(); }

  /// The name of the service in the keys of its scans.
  const std::string& identity() const { return host_.identity(); }
  /// The robots of the service, by name: they take what robots say.
  SessionList<CloudSession>& robots() { return host_.sessions(); }

  TeamStatus Status() const { return host_.Status(StatusOfModels()); }

  /// Fits all scans of every robot to each other. @pre the service has stopped.
  std::vector<std::pair<std::string, slam6d::RefinementResult>> Refine();

 private:
  std::shared_ptr<CloudSession> MakeSession(std::string robot);
  void Restore(KeptCloud scan);
  void Keep(const KeptCloud& scan);
  void TellMaps(const std::stop_token& stop);
  MapStatus StatusOfModels() const;

  const CloudServiceOptions options_;
  const SinkList<CloudSink> sinks_;
  const CloudContext context_;
  SessionHost<CloudSession> host_;  // Last: its threads use all members above.
};

}  // namespace qwsm::team
