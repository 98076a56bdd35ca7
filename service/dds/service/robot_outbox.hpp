// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/service/other_services.hpp"
#include "service/dds/service/pose_publisher.hpp"
#include "service/dds/wire/wire_kind.hpp"
#include "service/team/sinks/service_sink.hpp"

namespace qwsm::dds {

/// Publishes what a service answers one robot.
/// @tparam Kind team::Planar or team::Spatial.
template <class Kind>
class RobotOutbox {
 public:
  /// Makes the writers of a robot's answers.
  /// @param transforms writer of /tf, which all robots share; outlives this.
  RobotOutbox(const Participant& participant,
              const RobotNames& names,
              const Writer<wire::TFMessage>& transforms,
              const Claim& claim);

  /// Publishes pose, odometry and transform of an answer.
  void Publish(const team::Answer<Kind>& answer) const;
  /// Publishes the report, which goes last: who waits for it has everything.
  void Report(const team::Answer<Kind>& answer) const;

 private:
  PosePublisher<Kind> poses_;
  Writer<typename OnWire<Kind>::WireReport> reports_;
};

extern template class RobotOutbox<team::Planar>;
extern template class RobotOutbox<team::Spatial>;

}  // namespace qwsm::dds
