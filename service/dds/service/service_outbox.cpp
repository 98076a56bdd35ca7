// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/service_outbox.hpp"

#include <chrono>
#include <vector>

#include "service/dds/wire/diagnostics.hpp"

namespace qwsm::dds {

template <class Sink>
ServiceOutbox<Sink>::ServiceOutbox(const Participant& participant,
                                   const RosGraph& graph,
                                   const Refusals& refusals)
    : participant_(participant),
      refusals_(refusals),
      transforms_(participant, kTransformsTopic, Profile::kTransforms),
      diagnostics_(participant, kDiagnosticsTopic, Profile::kAnswer),
      robots_(graph) {}

template <class Sink>
void ServiceOutbox<Sink>::AddRobot(const std::string& robot, const Claim& claim) {
  robots_.Add(robot, participant_, RobotNames(robot), transforms_, claim);
}

template <class Sink>
void ServiceOutbox<Sink>::RemoveRobot(const std::string& robot) {
  robots_.Remove(robot);
}

template <class Sink>
void ServiceOutbox<Sink>::TakeAnswer(const team::Answer<typename Sink::Kind>& answer) {
  if (const auto robot = robots_.Find(answer.robot)) robot->Publish(answer);
}

template <class Sink>
void ServiceOutbox<Sink>::TakeReport(const team::Answer<typename Sink::Kind>& answer) {
  if (const auto robot = robots_.Find(answer.robot)) robot->Report(answer);
}

// Of the state of the service, which belongs to no scan.
template <class Sink>
void ServiceOutbox<Sink>::TakeStatus(const team::TeamStatus& status) {
  const Timestamp now = std::chrono::system_clock::now().time_since_epoch();
  const std::vector<Health> health = HealthOf(status, refusals_.All());
  diagnostics_.Write(HealthSample(health, now).sample());
}

template class ServiceOutbox<team::TeamSink>;
template class ServiceOutbox<team::CloudSink>;

}  // namespace qwsm::dds
