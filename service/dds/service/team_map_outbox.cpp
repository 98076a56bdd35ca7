// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/team_map_outbox.hpp"

#include <set>

#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/epoch_conversion.hpp"
#include "service/dds/wire/map_conversion.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/dds/wire/scan_conversion.hpp"
#include "service/team/scans/component.hpp"

namespace qwsm::dds {

TeamMapOutbox::TeamMapOutbox(const Participant& participant, const RosGraph& graph)
    : participant_(participant),
      new_points_(participant, kNewPointsTopic, Profile::kAnswer),
      shared_scans_(participant, kSharedScansTopic, Profile::kSharedScans),
      epochs_(participant, RobotNames("").Topic(kMapEpochTopic), Profile::kLatched),
      maps_(graph) {
  MapOf("");
}

void TeamMapOutbox::TakeRelevantScan(const team::TeamScan& scan) {
  const std::string frame = team::FrameOf(scan.component);
  shared_scans_.Write(ToWire(scan, frame));
}

void TeamMapOutbox::TakeNewPoints(const team::NewPoints& points) {
  const std::string frame = team::FrameOf(points.component);
  new_points_.Write(CloudSample(points.points_map_m, points.stamp, frame).sample());
}

void TeamMapOutbox::TakeMap(const team::MapPicture& map) {
  MapOf(map.component)->Write(MapSample(map.grid, map.stamp, map.frame).sample());
}

void TeamMapOutbox::TakeEpoch(const team::TeamEpoch& epoch) {
  epochs_.Write(EpochSample(epoch).sample());
  std::set<std::string> left;
  for (const team::MovedScan& scan : epoch.scans) left.insert(scan.component_before);
  for (const team::MovedScan& scan : epoch.scans) left.erase(scan.component);
  for (const std::string& component : left) maps_.Remove(component);
}

/// Of a component: below the name of the robot that has begun it.
std::shared_ptr<const TeamMapOutbox::MapWriter> TeamMapOutbox::MapOf(std::string_view component) {
  return maps_.Add(
      component, participant_, RobotNames(component).Topic(kMapTopic), Profile::kLatched);
}

}  // namespace qwsm::dds
