// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "service/team/journal/service_journal.hpp"
#include "service/team/service/cloud_options.hpp"
#include "service/team/service/cloud_session.hpp"
#include "service/team/service/periodic_task.hpp"
#include "service/team/session/session_list.hpp"
#include "service/team/sinks/cloud_sink.hpp"

namespace qwsm::team {

struct CloudServiceOptions {
  CloudTeamOptions team;
  slam6d::SlamOptions slam;
};

/// 6D SLAM for robots on the network: takes their clouds and odometry, answers each cloud with a
/// pose, and keeps a model for each robot.
///
/// All functions may be called from any thread, but not from the sink. A robot is known by its
/// namespace, such as `robot1`, or "" for the only one.
class CloudService {
 public:
  /// @param closer and sink outlive this.
  /// @param journal where scans are kept; the models begin with those in it. Empty: nowhere.
  /// @throws io::JournalError where it cannot be opened or is no journal.
  CloudService(const CloudServiceOptions& options,
               const slam6d::LoopCloser& closer,
               CloudSink& sink,
               const std::filesystem::path& journal = {});
  /// Stops.
  ~CloudService();
  CloudService(const CloudService&) = delete;
  CloudService& operator=(const CloudService&) = delete;

  /// Starts to work: first on what is in the journal. What arrives before waits.
  void Start();
  /// Finishes the registrations at work and works no more. What waits in queues is left out.
  void Stop();
  /// Waits until every scan that was taken is answered or dropped, and all is on disk that can be.
  void WaitUntilIdle();

  /// The name of the service in the keys of its scans.
  const std::string& identity() const { return journal_.identity(); }

  /// A robot's publisher is there. What takes messages of a robot makes it join as well.
  void Join(std::string_view robot) { sessions_.Join(robot); }
  /// It is gone.
  void Lose(std::string_view robot) { sessions_.Lose(robot); }
  /// Another service answers it from now on.
  void HandOver(std::string_view robot) { sessions_.HandOver(robot); }
  /// @return false if the scan was refused: malformed, late or a duplicate. See its counts.
  bool TakeScan(std::string_view robot, CloudScan scan) {
    return sessions_.TakeScan(robot, std::move(scan));
  }
  void TakeOdometry(std::string_view robot, Timestamp stamp, const slam6d::Pose3& T_odom_robot) {
    sessions_.TakeOdometry(robot, stamp, T_odom_robot);
  }
  /// Whether somebody publishes its odometry: only then do scans wait for it.
  void ExpectOdometry(std::string_view robot, bool expected) {
    sessions_.ExpectOdometry(robot, expected);
  }
  void PlaceAt(std::string_view robot, const slam6d::UncertainPose3& map_robot) {
    sessions_.PlaceAt(robot, map_robot);
  }

  TeamStatus Status() const;

  /// Fits all scans of every robot to each other. @pre it is stopped.
  std::vector<std::pair<std::string, slam6d::RefinementResult>> Refine();

 private:
  std::shared_ptr<CloudSession> MakeSession(std::string robot);
  void Restore(KeptCloud scan);
  void Keep(const KeptCloud& scan);
  void TellMaps(const std::stop_token& stop);

  const CloudServiceOptions options_;
  const CloudContext context_;
  const std::chrono::steady_clock::time_point begun_;
  SessionList<CloudSession> sessions_;
  ServiceJournal journal_;
  std::unique_ptr<PeriodicTask> merging_;
  std::unique_ptr<PeriodicTask> reporting_;
};

}  // namespace qwsm::team
