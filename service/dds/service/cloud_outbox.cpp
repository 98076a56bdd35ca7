// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/service/cloud_outbox.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <vector>

#include "service/dds/service/pose_publisher.hpp"
#include "service/dds/service/ros_graph.hpp"
#include "service/dds/wire/cloud_conversion.hpp"
#include "service/dds/wire/diagnostics.hpp"
#include "service/dds/wire/planar.hpp"
#include "service/dds/wire/registration_report.hpp"
#include "service/dds/wire/spatial.hpp"

namespace qwsm::dds {
namespace {

Timestamp Now() { return std::chrono::system_clock::now().time_since_epoch(); }

RegistrationReport ReportOf(const team::CloudAnswer& answer) {
  const slam6d::SlamStep& step = answer.step;
  const bool has_match = step.status == slam6d::SlamStatus::kMatched ||
                         step.status == slam6d::SlamStatus::kDeadReckoned;
  return {.robot = answer.robot,
          .stamp = answer.scan->stamp,
          .map_robot = answer.map_robot,
          .status = step.status,
          .reason = std::string(has_match ? Reason(step.match.status) : NameOf(step.status)),
          .points = static_cast<std::uint32_t>(step.points),
          .pairs = static_cast<std::uint32_t>(step.match.pairs),
          .iterations = static_cast<std::uint32_t>(step.match.iterations),
          .overlap = step.overlap,
          .rms_residual_m = step.match.rms_residual_m,
          .loops_to = {step.loops_to.begin(), step.loops_to.end()},
          .duration = answer.matching,
          .latency = answer.latency,
          .scans = answer.scans,
          .dropped = answer.dropped};
}

/// What is told about one robot.
struct Robot {
  Robot(const Participant& participant,
        const RobotNames& names,
        const Writer<wire::TFMessage>& transforms,
        const Claim& claim)
      : poses(participant, names, transforms),
        reports(participant, names.Topic(kRegistrationTopic), Profile::kAnswer, ToUserData(claim)),
        path(participant, names.Topic(kPathTopic), Profile::kLatched),
        cloud(participant, names.Topic(kCloudMapTopic), Profile::kLatched) {}

  PosePublisher<team::Spatial> poses;
  Writer<wire::RegistrationReport> reports;
  Writer<wire::Path> path;
  Writer<wire::PointCloud2> cloud;
};

}  // namespace

class CloudOutbox::Topics {
 public:
  Topics(const Participant& participant, const NetworkOptions& options, const Refusals& refusals)
      : participant_(participant),
        refusals_(refusals),
        transforms_(participant, kTransformsTopic, Profile::kTransforms),
        diagnostics_(participant, kDiagnosticsTopic, Profile::kAnswer),
        graph_(participant, options) {}

  void Add(const std::string& robot, const Claim& claim) {
    const std::lock_guard lock(mutex_);
    if (robots_.contains(robot)) return;
    robots_[robot] = std::make_shared<Robot>(participant_, RobotNames(robot), transforms_, claim);
    graph_.Announce();
  }
  void Remove(const std::string& robot) {
    const std::lock_guard lock(mutex_);
    robots_.erase(robot);
    graph_.Announce();
  }

  void TakePose(const team::CloudAnswer& answer) {
    const std::shared_ptr<const Robot> robot = Find(answer.robot);
    if (robot) robot->poses.Publish(answer.scan->stamp, answer.map_robot, answer.T_odom_robot);
  }

  // After the pose: who waits for the report has everything.
  void TakeReport(const team::CloudAnswer& answer) {
    const std::shared_ptr<const Robot> robot = Find(answer.robot);
    if (robot) robot->reports.Write(ToWire(ReportOf(answer), map_frame_));
  }

  void Take(const team::CloudMap& map) {
    const std::shared_ptr<const Robot> robot = Find(map.robot);
    if (!robot) return;
    const Timestamp newest = map.path.back().stamp;
    robot->cloud.Write(
        CloudSample(map.cloud, CloudPrecision::kSingle, newest, map_frame_).sample());
    std::vector<wire::PoseStamped> poses;
    for (const team::CloudMap::Stop& stop : map.path) {
      poses.push_back({HeaderOf(stop.stamp, map_frame_), ToWire(stop.T_map_robot)});
    }
    const auto size = static_cast<std::uint32_t>(poses.size());
    wire::Path path{};
    path.header = HeaderOf(newest, map_frame_);
    path.poses = {._maximum = size, ._length = size, ._buffer = poses.data(), ._release = false};
    robot->path.Write(path);
  }

  void Take(const team::TeamStatus& status) const {
    const std::vector<Health> health = HealthOf(status, refusals_.All());
    diagnostics_.Write(HealthSample(health, Now()).sample());
  }

 private:
  std::shared_ptr<const Robot> Find(std::string_view robot) {
    const std::lock_guard lock(mutex_);
    const auto known = robots_.find(robot);
    return known == robots_.end() ? nullptr : known->second;
  }

  const Participant& participant_;
  const Refusals& refusals_;
  std::string map_frame_ = kMapFrame;
  Writer<wire::TFMessage> transforms_;
  Writer<wire::DiagnosticArray> diagnostics_;
  RosGraph graph_;
  std::mutex mutex_;  // Of the list; what stands in it never changes.
  std::map<std::string, std::shared_ptr<const Robot>, std::less<>> robots_;
};

CloudOutbox::CloudOutbox(const Participant& participant,
                         const NetworkOptions& options,
                         const Refusals& refusals)
    : topics_(std::make_unique<Topics>(participant, options, refusals)) {}

CloudOutbox::~CloudOutbox() = default;

void CloudOutbox::AddRobot(const std::string& robot, const Claim& claim) {
  topics_->Add(robot, claim);
}
void CloudOutbox::RemoveRobot(const std::string& robot) { topics_->Remove(robot); }
void CloudOutbox::TakeAnswer(const team::CloudAnswer& answer) { topics_->TakePose(answer); }
void CloudOutbox::TakeReport(const team::CloudAnswer& answer) { topics_->TakeReport(answer); }
void CloudOutbox::TakeMap(const team::CloudMap& map) { topics_->Take(map); }
void CloudOutbox::TakeStatus(const team::TeamStatus& status) { topics_->Take(status); }

}  // namespace qwsm::dds
