// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/team/scans/team_epoch.hpp"
#include "service/team/scans/team_scan.hpp"
#include "service/team/sinks/service_sink.hpp"

namespace qwsm::team {

/// What a relevant scan has just added to the map.
struct NewPoints {
  std::string_view robot;
  std::string_view component;  ///< Of the team's map, that the scan is in.
  Timestamp stamp{};
  const std::vector<Eigen::Vector2d>& points_map_m;
};

/// A drawn map.
struct MapPicture {
  std::string_view component;  ///< Of the team's map; empty for the one that all share.
  std::string frame;           ///< Of the map.
  Timestamp stamp{};           ///< Stamp of the newest scan in the map.
  const OccupancyGrid& grid;
};

/// Takes what the service for a team has to tell.
class TeamSink : public ServiceSink<Planar> {
 public:
  /// Takes a relevant scan of a robot of this service, for the other services: safely in the
  /// journal if there is one that can be written. At the start, all of the journal; of other
  /// services, what was taken in of them when one is gone.
  virtual void TakeRelevantScan(const TeamScan&) {}
  /// Takes what a relevant scan added to the map, as safe in the journal as that scan.
  virtual void TakeNewPoints(const NewPoints&) {}
  virtual void TakeMap(const MapPicture&) {}
  /// Takes a correction of the maps, safely in the journal as a relevant scan is.
  virtual void TakeEpoch(const TeamEpoch&) {}
};

}  // namespace qwsm::team
