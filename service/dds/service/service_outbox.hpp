// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/service/robot_outbox.hpp"
#include "service/dds/service/robot_topics.hpp"
#include "service/dds/service/topics_by_robot.hpp"
#include "service/dds/wire/refusals.hpp"
#include "service/team/sinks/cloud_sink.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::dds {

/// Tells robots where they are, and operators how the service is.
/// @tparam Sink team::TeamSink or team::CloudSink.
template <class Sink>
class ServiceOutbox final : public Sink, public RobotTopics {
 public:
  /// Publishes answers as they come.
  /// @param participant and all others outlive this.
  /// @throws DdsError.
  ServiceOutbox(const Participant& participant, const RosGraph& graph, const Refusals& refusals);

  void AddRobot(const std::string& robot, const Claim& claim) override;
  void RemoveRobot(const std::string& robot) override;

  void TakeAnswer(const team::Answer<typename Sink::Kind>& answer) override;
  void TakeReport(const team::Answer<typename Sink::Kind>& answer) override;
  void TakeStatus(const team::TeamStatus& status) override;

 private:
  const Participant& participant_;
  const Refusals& refusals_;
  Writer<wire::TFMessage> transforms_;
  Writer<wire::DiagnosticArray> diagnostics_;
  TopicsByRobot<RobotOutbox<typename Sink::Kind>> robots_;
};

extern template class ServiceOutbox<team::TeamSink>;
extern template class ServiceOutbox<team::CloudSink>;

}  // namespace qwsm::dds
