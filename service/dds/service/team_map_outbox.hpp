// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/entities/writer.hpp"
#include "service/dds/service/topics_by_robot.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::dds {

/// Tells operators what the map is, and other services what is in it.
class TeamMapOutbox final : public team::TeamSink {
 public:
  /// Makes the topics of the map.
  /// @param participant and graph outlive this.
  /// @throws DdsError.
  TeamMapOutbox(const Participant& participant, const RosGraph& graph);

  void TakeRelevantScan(const team::TeamScan& scan) override;
  void TakeNewPoints(const team::NewPoints& points) override;
  void TakeMap(const team::MapPicture& map) override;
  void TakeEpoch(const team::TeamEpoch& epoch) override;

 private:
  using MapWriter = Writer<wire::OccupancyGrid>;

  std::shared_ptr<const MapWriter> MapOf(std::string_view component);

  const Participant& participant_;
  Writer<wire::PointCloud2> new_points_;
  Writer<wire::RelevantScan> shared_scans_;
  Writer<wire::MapEpoch> epochs_;
  TopicsByRobot<MapWriter> maps_;
};

}  // namespace qwsm::dds
