// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/team_map_outbox.hpp"

#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/map_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"

namespace qwsm::dds {

TeamMapOutbox::TeamMapOutbox(const Participant& participant, const RosGraph& graph)
    : participant_(participant),
      map_frame_(kMapFrame),
      new_points_(participant, kNewPointsTopic, Profile::kAnswer),
      shared_scans_(participant, kSharedScansTopic, Profile::kSharedScans),
      maps_(graph),
      epochs_(graph) {
  MapOf("");
  EpochOf("");
}

void TeamMapOutbox::TakeRelevantScan(const team::TeamScan& scan) {
  shared_scans_.Write(ToWire(scan, map_frame_));
}

void TeamMapOutbox::TakeNewPoints(const team::NewPoints& points) {
  new_points_.Write(CloudSample(points.points_map_m, points.stamp, map_frame_).sample());
}

void TeamMapOutbox::TakeMap(const team::MapPicture& map) {
  MapOf(map.robot)->Write(MapSample(map.grid, map.stamp, map_frame_).sample());
}

void TeamMapOutbox::TakeEpoch(const team::TeamEpoch& epoch) {
  EpochOf(epoch.robot)->Write(EpochSample(epoch, map_frame_).sample());
}

/// The team's map for no robot, else the robot's own.
std::shared_ptr<const TeamMapOutbox::MapWriter> TeamMapOutbox::MapOf(std::string_view robot) {
  return maps_.Add(robot, participant_, RobotNames(robot).Topic(kMapTopic), Profile::kLatched);
}

std::shared_ptr<const TeamMapOutbox::EpochWriter> TeamMapOutbox::EpochOf(std::string_view robot) {
  return epochs_.Add(
      robot, participant_, RobotNames(robot).Topic(kMapEpochTopic), Profile::kLatched);
}

}  // namespace qwsm::dds
