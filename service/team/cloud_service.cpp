// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/cloud_service.hpp"

#include <optional>

namespace qwsm::team {
namespace {

slam6d::UncertainPose3 StartOf(const RobotStartOptions& robot) {
  return {.T_a_b = {.rotation = slam6d::RotationFromRollPitchYaw({0.0, 0.0, robot.heading_rad}),
                    .translation_m = {robot.x_m, robot.y_m, 0.0}}};
}

}  // namespace

CloudService::CloudService(const CloudServiceOptions& options,
                           const slam6d::LoopCloser& closer,
                           CloudSink& sink)
    : options_(options),
      context_{.closer = closer, .sink = sink},
      begun_(std::chrono::steady_clock::now()),
      sessions_([this](std::string robot) { return MakeSession(std::move(robot)); }) {
  for (const RobotStartOptions& robot : options_.team.robots) {
    sessions_.PlaceAt(robot.name, StartOf(robot));
  }
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
}

TeamStatus CloudService::Status() const {
  TeamStatus status{.service = options_.team.service,
                    .uptime = std::chrono::steady_clock::now() - begun_,
                    .robots = sessions_.Statuses()};
  for (const RobotStatus& robot : status.robots) status.map.scans += robot.counts.relevant;
  for (const auto& session : sessions_.All()) status.map.points += session->map_points();
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
