// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/cloud_service.hpp"

#include <optional>
#include <utility>

#include "service/io/clouds/cloud_codec.hpp"

namespace qwsm::team {
namespace {

slam6d::UncertainPose3 StartOf(const RobotStartOptions& robot) {
  return {.T_a_b = {.rotation = slam6d::RotationFromRollPitchYaw({0.0, 0.0, robot.heading_rad}),
                    .translation_m = {robot.x_m, robot.y_m, 0.0}}};
}

io::JournalEntry ToJournal(const KeptCloud& kept, const std::string& service) {
  return {.service = service,
          .robot = kept.robot,
          .sequence = kept.sequence,
          .stamp = kept.scan->stamp,
          .contents = slam6d::io::EncodeCloud({.cloud = kept.scan->cloud,
                                               .T_robot_sensor = kept.scan->T_robot_sensor,
                                               .T_odom_sensor = kept.T_odom_sensor,
                                               .T_odom_robot = kept.T_odom_robot,
                                               .T_slam_odom = kept.T_slam_odom})};
}

KeptCloud FromJournal(const io::JournalEntry& entry) {
  slam6d::io::JournaledCloud kept = slam6d::io::DecodeCloud(entry.contents);
  return {
      .robot = entry.robot,
      .sequence = entry.sequence,
      .scan = std::make_shared<const CloudScan>(CloudScan{.stamp = entry.stamp,
                                                          .cloud = std::move(kept.cloud),
                                                          .T_robot_sensor = kept.T_robot_sensor}),
      .T_odom_sensor = kept.T_odom_sensor,
      .T_odom_robot = kept.T_odom_robot,
      .T_slam_odom = kept.T_slam_odom};
}

}  // namespace

CloudService::CloudService(const CloudServiceOptions& options,
                           const slam6d::LoopCloser& closer,
                           CloudSink& sink,
                           const std::filesystem::path& journal)
    : options_(options),
      context_{.closer = closer,
               .sink = sink,
               .keep = [this](const KeptCloud& scan) { Keep(scan); },
               .report =
                   [this](const CloudAnswer& answer) {
                     journal_.TellWhenSafe([this, answer] { context_.sink.TakeReport(answer); });
                   }},
      begun_(std::chrono::steady_clock::now()),
      sessions_([this](std::string robot) { return MakeSession(std::move(robot)); }),
      journal_(options.team.service,
               {.file = journal, .kind = slam6d::io::kCloudJournal},
               [&sink](const TeamEvent& event) { sink.TakeEvent(event); }) {
  for (const RobotStartOptions& robot : options_.team.robots) {
    sessions_.PlaceAt(robot.name, StartOf(robot));
  }
  journal_.Restore([this](const io::JournalEntry& entry) { Restore(FromJournal(entry)); });
}

CloudService::~CloudService() { Stop(); }

void CloudService::Start() {
  const CloudTeamOptions& team = options_.team;
  sessions_.Start(team.threads);
  if (team.map_period_s > 0.0) {
    merging_ =
        std::make_unique<PeriodicTask>(std::chrono::duration<double>(team.map_period_s),
                                       true,
                                       [this](const std::stop_token& stop) { TellMaps(stop); });
  }
  reporting_ = std::make_unique<PeriodicTask>(
      std::chrono::duration<double>(team.status_period_s), false, [this](const std::stop_token&) {
        context_.sink.TakeStatus(Status());
      });
}

void CloudService::Stop() {
  merging_.reset();
  reporting_.reset();
  sessions_.Stop();
  journal_.Stop();
}

void CloudService::WaitUntilIdle() {
  sessions_.WaitUntilIdle();
  journal_.WaitUntilSettled();
}

void CloudService::Restore(KeptCloud scan) {
  if (const auto session = sessions_.Of(scan.robot)) session->Restore(std::move(scan));
}

void CloudService::Keep(const KeptCloud& scan) {
  if (journal_) journal_.Append(ToJournal(scan, identity()), {});
}

TeamStatus CloudService::Status() const {
  TeamStatus status{.service = identity(),
                    .uptime = std::chrono::steady_clock::now() - begun_,
                    .robots = sessions_.Statuses(),
                    .journal = journal_.Status()};
  for (const auto& session : sessions_.All()) {
    const MapStatus model = session->ModelStatus();
    status.map.scans += model.scans;
    status.map.points += model.points;
  }
  return status;
}

std::vector<std::pair<std::string, slam6d::RefinementResult>> CloudService::Refine() {
  std::vector<std::pair<std::string, slam6d::RefinementResult>> refined;
  for (const auto& session : sessions_.All()) {
    refined.emplace_back(session->name(), session->Refine());
  }
  return refined;
}

std::shared_ptr<CloudSession> CloudService::MakeSession(std::string robot) {
  return std::make_shared<CloudSession>(std::move(robot), options_.team, options_.slam, context_);
}

void CloudService::TellMaps(const std::stop_token& stop) {
  for (const auto& session : sessions_.All()) {
    if (stop.stop_requested()) return;
    if (const std::optional<CloudMap> map = session->NewMap()) context_.sink.TakeMap(*map);
  }
}

}  // namespace qwsm::team
