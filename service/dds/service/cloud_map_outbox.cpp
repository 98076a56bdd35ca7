// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/cloud_map_outbox.hpp"

#include <cstdint>
#include <vector>

#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/spatial.hpp"

namespace qwsm::dds {

CloudMapOutbox::MapWriters::MapWriters(const Participant& participant, const RobotNames& names)
    : path(participant, names.Topic(kPathTopic), Profile::kLatched),
      cloud(participant, names.Topic(kCloudMapTopic), Profile::kLatched) {}

void CloudMapOutbox::AddRobot(const std::string& robot, const Claim&) {
  maps_.Add(robot, participant_, RobotNames(robot));
}

void CloudMapOutbox::RemoveRobot(const std::string& robot) { maps_.Remove(robot); }

void CloudMapOutbox::TakeMap(const team::CloudMap& map) {
  const auto writers = maps_.Find(map.robot);
  if (!writers) return;
  const Timestamp newest = map.path.back().stamp;
  writers->cloud.Write(
      CloudSample(map.cloud, CloudPrecision::kSingle, newest, map_frame_).sample());
  std::vector<wire::PoseStamped> poses;
  for (const team::CloudMap::Stop& stop : map.path) {
    poses.push_back({HeaderOf(stop.stamp, map_frame_), ToWire(stop.T_map_robot)});
  }
  const auto size = static_cast<std::uint32_t>(poses.size());
  wire::Path path{};
  path.header = HeaderOf(newest, map_frame_);
  path.poses = {._maximum = size, ._length = size, ._buffer = poses.data(), ._release = false};
  writers->path.Write(path);
}

}  // namespace qwsm::dds
