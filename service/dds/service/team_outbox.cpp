// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/team_outbox.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>

#include "service/dds/entities/writer.hpp"
#include "service/dds/service/robot_outbox.hpp"
#include "service/dds/service/ros_graph.hpp"
#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/diagnostics.hpp"
#include "service/dds/wire/map_conversion.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/scan_conversion.hpp"

namespace qwsm::dds {
namespace {

// Of the state of the service, which belongs to no scan.
Timestamp Now() { return std::chrono::system_clock::now().time_since_epoch(); }

}  // namespace

class TeamOutbox::Topics {
 public:
  Topics(const Participant& participant, const NetworkOptions& options, const Refusals& refusals)
      : participant_(participant),
        refusals_(refusals),
        transforms_(participant, kTransformsTopic, Profile::kTransforms),
        new_points_(participant, kNewPointsTopic, Profile::kAnswer),
        diagnostics_(participant, kDiagnosticsTopic, Profile::kAnswer),
        shared_scans_(participant, kSharedScansTopic, Profile::kSharedScans),
        graph_(participant, options) {
    MapOf("");
  }

  void Add(const std::string& robot, const Claim& claim) {
    const std::lock_guard lock(mutex_);
    if (robots_.contains(robot)) return;
    robots_[robot] =
        std::make_shared<RobotOutbox>(participant_, RobotNames(robot), transforms_, claim);
    graph_.Announce();
  }
  void Remove(const std::string& robot) {
    const std::lock_guard lock(mutex_);
    robots_.erase(robot);
    graph_.Announce();
  }

  void Take(const team::RobotAnswer& answer) {
    if (const auto robot = Find(answer.robot)) robot->Publish(answer);
  }
  void Report(const team::RobotAnswer& answer) {
    if (const auto robot = Find(answer.robot)) robot->Report(answer);
  }
  void Take(const team::TeamScan& scan) const { shared_scans_.Write(ToWire(scan, map_frame_)); }
  void Take(const team::NewPoints& points) const {
    new_points_.Write(CloudSample(points.points_map_m, points.stamp, map_frame_).sample());
  }
  void Take(const team::MapPicture& map) {
    MapOf(map.robot).Write(MapSample(map.grid, map.stamp, map_frame_).sample());
  }
  void Take(const team::TeamStatus& status) const {
    const std::vector<Health> health = HealthOf(status, refusals_.All());
    diagnostics_.Write(HealthSample(health, Now()).sample());
  }

 private:
  using MapWriter = Writer<wire::OccupancyGrid>;

  std::shared_ptr<const RobotOutbox> Find(const std::string& robot) {
    const std::lock_guard lock(mutex_);
    const auto known = robots_.find(robot);
    return known == robots_.end() ? nullptr : known->second;
  }

  /// The team's map for no robot, else the robot's own.
  const MapWriter& MapOf(std::string_view robot) {
    const std::lock_guard lock(mutex_);
    const auto known = maps_.find(robot);
    if (known != maps_.end()) return known->second;
    const std::string topic = RobotNames(robot).Topic(kMapTopic);
    const auto added =
        maps_.try_emplace(std::string(robot), participant_, topic, Profile::kLatched);
    graph_.Announce();
    return added.first->second;
  }

  const Participant& participant_;
  const Refusals& refusals_;
  std::string map_frame_ = kMapFrame;
  Writer<wire::TFMessage> transforms_;
  Writer<wire::PointCloud2> new_points_;
  Writer<wire::DiagnosticArray> diagnostics_;
  Writer<wire::RelevantScan> shared_scans_;
  RosGraph graph_;
  std::mutex mutex_;  // Of the two lists; what stands in them never changes.
  std::map<std::string, MapWriter, std::less<>> maps_;
  std::map<std::string, std::shared_ptr<const RobotOutbox>> robots_;
};

TeamOutbox::TeamOutbox(const Participant& participant,
                       const NetworkOptions& options,
                       const Refusals& refusals)
    : topics_(std::make_unique<Topics>(participant, options, refusals)) {}

TeamOutbox::~TeamOutbox() = default;

void TeamOutbox::AddRobot(const std::string& robot, const Claim& claim) {
  topics_->Add(robot, claim);
}
void TeamOutbox::RemoveRobot(const std::string& robot) { topics_->Remove(robot); }
void TeamOutbox::TakeAnswer(const team::RobotAnswer& answer) { topics_->Take(answer); }
void TeamOutbox::TakeReport(const team::RobotAnswer& answer) { topics_->Report(answer); }
void TeamOutbox::TakeRelevantScan(const team::TeamScan& scan) { topics_->Take(scan); }
void TeamOutbox::TakeNewPoints(const team::NewPoints& points) { topics_->Take(points); }
void TeamOutbox::TakeMap(const team::MapPicture& map) { topics_->Take(map); }
void TeamOutbox::TakeStatus(const team::TeamStatus& status) { topics_->Take(status); }

}  // namespace qwsm::dds
