// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/cloud_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "slam6d/geometry/position.hpp"

namespace qwsm::team {
namespace {

using slam6d::Pose3;
using std::chrono::steady_clock;

/// The same pose, to the last bit, where there is nothing to be added.
Pose3 Moved(const std::optional<Pose3>& T_a_b, const Pose3& T_b_c) {
  return T_a_b ? *T_a_b * T_b_c : T_b_c;
}

/// The robot by its sensor.
slam6d::UncertainPose3 RobotBy(const slam6d::SlamStep& step, const Pose3& T_robot_sensor) {
  return slam6d::UncertainPose3{step.T_map_scan, step.covariance} *
         slam6d::UncertainPose3{T_robot_sensor.Inverse()};
}

}  // namespace

CloudSession::CloudSession(std::string name,
                           const CloudTeamOptions& options,
                           const slam6d::SlamOptions& slam,
                           const CloudContext& context)
    : thinning_(options.map),
      context_(context),
      events_(
          std::move(name),
          [this](const TeamEvent& event) { context_.sinks.Tell(&CloudSink::TakeEvent, event); }),
      intake_(events_, options.session),
      slam_(slam, context.closer) {}

void CloudSession::Restore(KeptCloud kept) {
  intake_.GoOnFrom(kept.scan->stamp, kept.T_odom_robot);
  const std::lock_guard lock(mutex_);
  to_restore_.push_back(std::move(kept));
}

void CloudSession::PlaceAt(const slam6d::UncertainPose3& map_robot) {
  const std::string_view objection = ObjectionTo(map_robot);
  if (!objection.empty()) return events_.Warn(objection);
  const std::lock_guard lock(mutex_);
  if (!stops_.empty() || !to_restore_.empty()) {
    return events_.Warn("its model has begun: it is where its scans say");
  }
  T_map_start_ = map_robot.T_a_b;
}

std::optional<Lane::Time> CloudSession::ReadyAt() const {
  {
    const std::lock_guard lock(mutex_);
    if (!to_restore_.empty()) return Time{};
  }
  return intake_.ReadyAt();
}

void CloudSession::RunOne() {
  if (RestoreOne()) return;
  std::optional<Work> work = intake_.Take();
  if (!work) return;
  if (work->T_robot_sensor_claimed && !std::exchange(is_claim_told_, true)) {
    events_.Warn("/tf_static has its scanner elsewhere while it drives: not before it joins anew");
  }
  T_odom_sensor_last_ = EstimateSensor(*work);
  const auto scan = std::make_shared<const CloudScan>(std::move(work->scan));
  CloudAnswer answer = Register(scan);
  const SessionCounts counts = Note(*work, answer);
  answer.T_odom_robot = work->T_odom_robot;
  answer.lacks_odometry = work->lacks_odometry;
  answer.latency = steady_clock::now() - work->arrived;
  answer.scans = counts.scans;
  answer.dropped = counts.dropped;
  context_.sinks.Tell(&CloudSink::TakeAnswer, answer);
  context_.keep({.robot = name(),
                 .sequence = ++sequence_,
                 .scan = scan,
                 .T_odom_sensor = T_odom_sensor_last_,
                 .T_odom_robot = work->T_odom_robot,
                 .T_slam_odom = T_slam_odom_});
  context_.report(answer);
}

/// @return false where there is nothing to be restored.
bool CloudSession::RestoreOne() {
  std::unique_lock lock(mutex_);
  if (to_restore_.empty()) return false;
  const KeptCloud kept = std::move(to_restore_.front());
  to_restore_.pop_front();
  const bool is_last = to_restore_.empty();
  lock.unlock();
  sequence_ = std::max(sequence_, kept.sequence);
  T_odom_sensor_last_ = kept.T_odom_sensor;
  T_slam_odom_ = kept.T_slam_odom;
  context_.sinks.Tell(&CloudSink::TakeRestored, Register(kept.scan));
  if (is_last) {
    events_.Inform(
        fmt::format("has its {} scans back from the journal", slam_.T_map_scan().size()));
  }
  return true;
}

CloudAnswer CloudSession::Register(const std::shared_ptr<const CloudScan>& scan) {
  const auto begun = steady_clock::now();
  slam6d::SlamStep registration = slam_.Add(scan->cloud, T_odom_sensor_last_);
  const auto matching = steady_clock::now() - begun;
  Draw(*scan);
  const slam6d::UncertainPose3 map_robot = RobotBy(registration, scan->T_robot_sensor);
  return {.robot = name(),
          .step = {.stamp = scan->stamp,
                   .map_robot = map_robot,
                   .scan = scan,
                   .T_odom_sensor = T_odom_sensor_last_,
                   .registration = std::move(registration)},
          .matching = matching};
}

/// Where to begin the registration: what odometry says, carried on from the scan before.
Pose3 CloudSession::EstimateSensor(const Work& work) {
  const std::vector<Pose3>& poses = slam_.T_map_scan();
  if (poses.empty()) return EstimateFirst(work);
  const Pose3& T_robot_sensor = work.scan.T_robot_sensor;
  if (work.odometry_goes_on && !work.odometry_jumped) {
    return Moved(T_slam_odom_, *work.T_odom_robot * T_robot_sensor);
  }
  Pose3 estimate = T_odom_sensor_last_;
  if (poses.size() > 1 && !work.is_interrupted) {
    estimate = estimate * (poses[poses.size() - 2].Inverse() * poses.back());
  }
  if (work.T_odom_robot) {
    T_slam_odom_ = estimate * (*work.T_odom_robot * T_robot_sensor).Inverse();
  }
  return estimate;
}

Pose3 CloudSession::EstimateFirst(const Work& work) {
  const Pose3& T_robot_sensor = work.scan.T_robot_sensor;
  const std::lock_guard lock(mutex_);
  if (!T_map_start_) return work.T_odom_robot.value_or(Pose3{}) * T_robot_sensor;
  if (work.T_odom_robot) T_slam_odom_ = *T_map_start_ * work.T_odom_robot->Inverse();
  return *T_map_start_ * T_robot_sensor;
}

void CloudSession::Draw(const CloudScan& scan) {
  auto thinned = std::make_shared<const slam6d::PointCloud>(Reduce(scan.cloud, thinning_));
  const std::lock_guard lock(mutex_);
  stops_.push_back({scan.stamp, scan.T_robot_sensor, std::move(thinned)});
  T_map_sensor_ = slam_.T_map_scan();
  is_map_new_ = true;
}

SessionCounts CloudSession::Note(const Work& work, const CloudAnswer& answer) {
  const slam6d::SlamStatus status = answer.step.registration.status;
  return intake_.NoteAnswer({.stamp = answer.step.stamp,
                             .arrived = work.arrived,
                             .working = answer.matching,
                             .is_dead_reckoned = status == slam6d::SlamStatus::kDeadReckoned ||
                                                 status == slam6d::SlamStatus::kUnusable,
                             .relevant = status != slam6d::SlamStatus::kUnusable ? 1U : 0U,
                             .has_odometry = work.T_odom_robot.has_value()});
}

std::optional<CloudMap> CloudSession::NewMap() {
  std::vector<Stop> stops;
  std::vector<Pose3> T_map_sensor;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(is_map_new_, false)) return std::nullopt;
    stops = stops_;
    T_map_sensor = T_map_sensor_;
  }
  CloudMap map{.robot = name(), .path = {}, .cloud = {}};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    map.path.push_back({stops[i].stamp, T_map_sensor[i] * stops[i].T_robot_sensor.Inverse()});
    map.cloud.Append(T_map_sensor[i] * *stops[i].thinned);
  }
  map.cloud = Reduce(map.cloud, thinning_);
  return map;
}

MapStatus CloudSession::ModelStatus() const {
  const std::lock_guard lock(mutex_);
  MapStatus status{.scans = stops_.size()};
  for (const Stop& stop : stops_) status.points += stop.thinned->size();
  return status;
}

}  // namespace qwsm::team
