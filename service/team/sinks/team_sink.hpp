// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/team/scans/team_scan.hpp"
#include "service/team/sinks/team_status.hpp"

namespace qwsm::team {

/// The answer to one scan.
struct RobotAnswer {
  std::string robot;
  MappingStep step;
  std::optional<Pose2> T_odom_robot;    ///< At the scan's stamp.
  std::chrono::nanoseconds matching{};  ///< Time the match took.
  std::chrono::nanoseconds latency{};   ///< From the scan's arrival to now.
  std::uint64_t scans = 0;              ///< Of this robot so far.
  std::uint64_t dropped = 0;            ///< Of these, because the queue was full.
};

/// What a relevant scan has just added to the map.
struct NewPoints {
  std::string_view robot;
  Timestamp stamp{};
  const std::vector<Eigen::Vector2d>& points_map_m;
};

/// A drawn map.
struct MapPicture {
  std::string_view robot;  ///< Whose map it is; empty for the team's.
  Timestamp stamp{};       ///< Of the newest scan in it.
  const OccupancyGrid& grid;
};

/// Something worth a line in the log: a robot joined, a clock was set back, the disk is full.
struct TeamEvent {
  std::optional<std::string_view> robot;  ///< Nothing where it is about none.
  bool is_warning = false;
  std::string_view text;
};

/// Takes what the service has to tell: topics, files, a test. Called from several threads at once,
/// for each robot in the order of its scans. Must not throw, and not call the service.
class TeamSink {
 public:
  TeamSink() = default;
  TeamSink(const TeamSink&) = delete;
  TeamSink& operator=(const TeamSink&) = delete;
  virtual ~TeamSink() = default;

  /// A pose, as soon as it is known.
  virtual void TakeAnswer(const RobotAnswer& answer) = 0;
  /// The same again, once all that the service knew by then is safely in the journal, if there is
  /// one that can be written: that a scan extended the map is told of no scan that may be lost.
  virtual void TakeReport(const RobotAnswer& answer) = 0;
  /// A relevant scan of a robot of this service, for the other services: safely in the journal if
  /// there is one that can be written. At the start, all of the journal; of other services, what
  /// was taken in of them when one is gone.
  virtual void TakeRelevantScan(const TeamScan& scan) = 0;
  /// What it added to the map; as safe.
  virtual void TakeNewPoints(const NewPoints& points) = 0;
  virtual void TakeMap(const MapPicture& map) = 0;
  virtual void TakeStatus(const TeamStatus& status) = 0;
  virtual void TakeEvent(const TeamEvent& event) = 0;
};

}  // namespace qwsm::team
