// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/cloud_service.hpp"

#include <optional>
#include <utility>

#include "service/io/clouds/cloud_codec.hpp"

namespace qwsm::team {
namespace {

slam6d::UncertainPose3 SpatialStart(const RobotStartOptions& robot) {
  return {.T_a_b = {.rotation = slam6d::RotationFromRollPitchYaw({0.0, 0.0, robot.heading_rad}),
                    .translation_m = {robot.x_m, robot.y_m, 0.0}}};
}

io::JournalEntry CloudEntry(const KeptCloud& kept, const std::string& service) {
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

KeptCloud CloudFromJournal(const io::JournalEntry& entry) {
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
                           SinkList<CloudSink> sinks,
                           const std::filesystem::path& journal)
    : options_(options),
      sinks_(std::move(sinks)),
      context_{.closer = closer,
               .sinks = sinks_,
               .keep = [this](const KeptCloud& scan) { Keep(scan); },
               .report =
                   [this](const CloudAnswer& answer) {
                     host_.journal().TellWhenSafe(
                         [this, answer] { sinks_.Tell(&CloudSink::TakeReport, answer); });
                   }},
      host_(
          options_.team,
          {.file = journal, .kind = slam6d::io::kCloudJournal},
          [this](const TeamEvent& event) { sinks_.Tell(&CloudSink::TakeEvent, event); },
          [this](std::string robot) { return MakeSession(std::move(robot)); }) {
  host_.Restore([this](const io::JournalEntry& entry) { Restore(CloudFromJournal(entry)); });
  host_.ExpectRobots();
}

CloudService::~CloudService() { Stop(); }

void CloudService::Start() {
  host_.Start({.tell_status = [this] { sinks_.Tell(&CloudSink::TakeStatus, Status()); },
               .tell_maps = [this](const std::stop_token& stop) { TellMaps(stop); },
               .map_period = std::chrono::duration<double>(options_.team.map_period_s)});
}

void CloudService::Restore(KeptCloud scan) {
  if (const auto session = robots().Of(scan.robot)) session->Restore(std::move(scan));
}

void CloudService::Keep(const KeptCloud& scan) {
  if (host_.journal()) host_.journal().Append(CloudEntry(scan, identity()), {});
}

MapStatus CloudService::StatusOfModels() const {
  MapStatus status;
  for (const auto& session : host_.sessions().All()) {
    const MapStatus model = session->ModelStatus();
    status.scans += model.scans;
    status.points += model.points;
  }
  return status;
}

std::vector<std::pair<std::string, slam6d::RefinementResult>> CloudService::Refine() {
  std::vector<std::pair<std::string, slam6d::RefinementResult>> refined;
  for (const auto& session : robots().All()) {
    refined.emplace_back(session->name(), session->Refine());
  }
  return refined;
}

std::shared_ptr<CloudSession> CloudService::MakeSession(std::string robot) {
  const RobotStartOptions* const start = FindStart(options_.team, robot);
  auto session =
      std::make_shared<CloudSession>(std::move(robot), options_.team, options_.slam, context_);
  if (start) session->PlaceAt(SpatialStart(*start));
  return session;
}

void CloudService::TellMaps(const std::stop_token& stop) {
  for (const auto& session : robots().All()) {
    if (stop.stop_requested()) return;
    if (const std::optional<CloudMap> map = session->NewMap()) {
      sinks_.Tell(&CloudSink::TakeMap, *map);
    }
  }
}

}  // namespace qwsm::team
