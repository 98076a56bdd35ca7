// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "service/dds/entities/participant.hpp"
#include "service/dds/service/other_services.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::dds {

/// Tells robots, operators and other services what the service finds.
class TeamOutbox final : public team::TeamSink {
 public:
  /// @param participant and refusals outlive this. @throws DdsError.
  TeamOutbox(const Participant& participant,
             const NetworkOptions& options,
             const Refusals& refusals);
  ~TeamOutbox() override;

  /// Makes the topics of a robot, so that listeners find them before its first scan is answered.
  void AddRobot(const std::string& robot, const Claim& claim);
  /// Takes them away: another service answers the robot. Answers still on their way are dropped.
  void RemoveRobot(const std::string& robot);

  void TakeAnswer(const team::RobotAnswer& answer) override;
  void TakeReport(const team::RobotAnswer& answer) override;
  void TakeRelevantScan(const team::TeamScan& scan) override;
  void TakeNewPoints(const team::NewPoints& points) override;
  void TakeMap(const team::MapPicture& map) override;
  void TakeStatus(const team::TeamStatus& status) override;
  void TakeEvent(const team::TeamEvent&) override {}

 private:
  class Topics;
  std::unique_ptr<Topics> topics_;
};

}  // namespace qwsm::dds
