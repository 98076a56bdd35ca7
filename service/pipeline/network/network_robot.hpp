// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "service/dds/robot/command_reader.hpp"
#include "service/dds/robot/match_report_reader.hpp"
#include "service/dds/robot/robot_publisher.hpp"
#include "service/pipeline/network/answer_window.hpp"
#include "service/pipeline/simulation/reading_sink.hpp"
#include "sim/simulation.hpp"

namespace qwsm::pipeline {

/// Says whether the simulator waits for the service.
enum class NetworkPace { kFree, kAnswers };

/// A simulated robot on the network: publishes what it measures and where it really is, and takes
/// commands if somebody outside drives it. Robots of a team say once where they start, as their
/// options have it, so that the frame of their map is that of the world.
class NetworkRobot final : public ReadingSink {
 public:
  /// Publishes one robot.
  /// @param robot index in the simulation, which outlives this, as does the participant.
  /// @param is_watched whether scans are of use where no service listens: for a page.
  NetworkRobot(const dds::Participant& participant,
               sim::Simulation& simulation,
               std::size_t robot,
               NetworkPace pace,
               bool is_watched = false);

  /// Waits until somebody listens. @returns false where nobody listens in time.
  bool WaitForListener(std::chrono::nanoseconds timeout);

  /// Publishes a reading; readings of other robots are passed over.
  void Take(const sim::Reading& reading) override;
  /// Waits until the last scan is answered.
  void Finish();

  const dds::RobotNames& names() const { return publisher_.names(); }

 private:
  bool HasBegun(const sim::Reading& reading);

  sim::Simulation& simulation_;
  std::size_t robot_;
  NetworkPace pace_;
  bool is_watched_;
  bool has_begun_;
  int scans_held_back_ = 0;
  dds::MatchReportReader reports_;
  dds::CommandReader commands_;
  dds::RobotPublisher publisher_;
  AnswerWindow window_;
};

}  // namespace qwsm::pipeline
