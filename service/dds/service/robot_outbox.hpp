// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/service/other_services.hpp"
#include "service/dds/service/pose_publisher.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::dds {

/// What the service tells about one robot.
class RobotOutbox {
 public:
  /// @param transforms writer of /tf, which all robots share; outlives this.
  RobotOutbox(const Participant& participant,
              const RobotNames& names,
              const Writer<wire::TFMessage>& transforms,
              const Claim& claim);

  /// Pose, odometry and transform.
  void Publish(const team::RobotAnswer& answer) const;
  /// The report, which goes last: who waits for it has everything.
  void Report(const team::RobotAnswer& answer) const;

 private:
  std::string map_frame_;
  PosePublisher<team::Planar> poses_;
  Writer<wire::MatchReport> reports_;
};

}  // namespace qwsm::dds
