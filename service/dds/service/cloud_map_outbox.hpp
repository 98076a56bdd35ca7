// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "service/dds/entities/writer.hpp"
#include "service/dds/service/robot_topics.hpp"
#include "service/dds/service/topics_by_robot.hpp"
#include "service/dds/wire/robot_names.hpp"
#include "service/team/sinks/cloud_sink.hpp"

namespace qwsm::dds {

/// Tells operators what each robot's clouds have come to: its path, and all clouds in one.
class CloudMapOutbox final : public team::CloudSink, public RobotTopics {
 public:
  /// Publishes nothing before a robot is added. @param participant and graph outlive this.
  CloudMapOutbox(const Participant& participant, const RosGraph& graph)
      : participant_(participant), maps_(graph) {}

  /// Makes the topics of a robot. @throws DdsError.
  void AddRobot(const std::string& robot, const Claim& claim) override;
  void RemoveRobot(const std::string& robot) override;

  void TakeMap(const team::CloudMap& map) override;

 private:
  struct MapWriters {
    MapWriters(const Participant& participant, const RobotNames& names);

    Writer<wire::Path> path;
    Writer<wire::PointCloud2> cloud;
  };

  const Participant& participant_;
  const std::string map_frame_ = kMapFrame;
  TopicsByRobot<MapWriters> maps_;
};

}  // namespace qwsm::dds
