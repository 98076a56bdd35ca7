// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "service/team/scans/map_version.hpp"
#include "service/team/scans/sensor_kind.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

/// Where a relevant scan was taken, in a map.
template <class Kind>
struct RelevantPlace {
  Timestamp stamp{};
  typename Kind::UncertainPose map_robot;
};

/// The answer to one scan.
/// @tparam Kind Planar or Spatial.
template <class Kind>
struct Answer {
  std::string robot;
  typename Kind::Step step;
  std::string component{};  ///< Of the team's map, that the step's pose is in.
  MapVersion version{};     ///< Of that map, where robots share one.
  /// The robot's last relevant scan before this one in that map, as it was then; none where the
  /// robot has not extended it since it was put there.
  std::optional<RelevantPlace<Kind>> last_relevant{};
  std::optional<typename Kind::Pose> T_odom_robot{};  ///< Odometry at the scan's stamp.
  /// Whether there is none of that stamp though the robot's odometry is published: where its frame
  /// `odom` lies in the map is not known anew.
  bool lacks_odometry = false;
  /// Where who drives by it is told that the robot is, as long as a correction of the map has not
  /// reached it in full; nothing where that is the answer.
  std::optional<typename Kind::UncertainPose> told{};
  std::chrono::nanoseconds matching{};  ///< Time the match took.
  std::chrono::nanoseconds latency{};   ///< From the scan's arrival to now.
  std::uint64_t scans = 0;              ///< Scans of this robot so far.
  /// Scans of this robot that were dropped because the queue was full.
  std::uint64_t dropped = 0;
};

using RobotAnswer = Answer<Planar>;
using CloudAnswer = Answer<Spatial>;

/// Something worth a line in the log: a robot joined, a clock was set back, the disk is full.
struct TeamEvent {
  std::optional<std::string_view> robot;  ///< Nothing where the event is about no robot.
  bool is_warning = false;
  std::string_view text;
};

using TellEvent = std::function<void(const TeamEvent&)>;

/// Takes what a service has to tell, whatever its robots' sensors are: topics, files, a test. What
/// is of no use to a sink it does not override. Called from several threads at once, for each robot
/// in the order of its scans. Must not throw, and not call the service.
template <class SensorKind>
class ServiceSink {
 public:
  using Kind = SensorKind;

  ServiceSink() = default;
  ServiceSink(const ServiceSink&) = delete;
  ServiceSink& operator=(const ServiceSink&) = delete;
  virtual ~ServiceSink() = default;

  /// Takes a scan's answer, as soon as its pose is known.
  virtual void TakeAnswer(const Answer<Kind>&) {}
  /// Takes a scan's answer again, once all that the service knew by then is safely in the journal,
  /// if there is one that can be written: that a scan extended the map is told of no scan that may
  /// be lost.
  virtual void TakeReport(const Answer<Kind>&) {}
  virtual void TakeStatus(const TeamStatus&) {}
  virtual void TakeEvent(const TeamEvent&) {}
};

}  // namespace qwsm::team
