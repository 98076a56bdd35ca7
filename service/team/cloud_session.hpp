// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/cloud_options.hpp"
#include "service/team/cloud_sink.hpp"
#include "service/team/session_intake.hpp"

namespace qwsm::team {

/// What a session for clouds is given by the service that keeps it.
struct CloudContext {
  const slam6d::LoopCloser& closer;
  CloudSink& sink;
};

/// One robot with a 3D scanner: takes its messages from any thread, registers its scans one by one
/// in a worker, each into the robot's own model.
///
/// The model begins where the robot is told to be, else where its odometry has it. Where odometry
/// is missing or begins anew, the motion before goes on.
class CloudSession final : public Lane {
 public:
  CloudSession(std::string name,
               const CloudTeamOptions& options,
               const slam6d::SlamOptions& slam,
               const CloudContext& context);

  const std::string& name() const { return intake_.name(); }

  /// Where the robot is now; counts until its first scan.
  void PlaceAt(const slam6d::UncertainPose3& map_robot);
  void Join();
  void Lose();
  void HandOver();
  /// @return false if it was refused. A scan that is taken may still be dropped for newer ones.
  bool TakeScan(CloudScan scan);
  void TakeOdometry(Timestamp stamp, const slam6d::Pose3& T_odom_robot) {
    intake_.TakeOdometry(stamp, T_odom_robot);
  }
  void ExpectOdometry(bool expected) { intake_.ExpectOdometry(expected); }

  RobotStatus Status() const { return intake_.Status(); }
  std::optional<Time> ReadyAt() const override { return intake_.ReadyAt(); }
  void RunOne() override;

  /// The model, if it has changed since the last call.
  std::optional<CloudMap> NewMap();
  /// Fits all scans to each other. @pre no worker runs.
  slam6d::RefinementResult Refine() { return slam_.Refine(); }
  /// Points of all thinned scans.
  std::size_t map_points() const;

 private:
  using Work = SessionIntake<Spatial>::Work;

  /// What is kept of a scan for the merged cloud.
  struct Stop {
    Timestamp stamp{};
    slam6d::Pose3 T_robot_sensor;
    std::shared_ptr<const slam6d::PointCloud> thinned;
  };

  slam6d::Pose3 EstimateSensor(const Work& work);
  slam6d::Pose3 EstimateFirst(const Work& work);
  void Keep(const CloudScan& scan);
  void Answer(const Work& work, const slam6d::SlamStep& step, std::chrono::nanoseconds matching);
  void Tell(bool is_warning, std::string_view text) const;

  const slam6d::ReductionOptions thinning_;
  const CloudContext context_;
  SessionIntake<Spatial> intake_;

  // Of the worker alone.
  slam6d::Slam slam_;
  slam6d::Pose3 T_odom_sensor_last_;          // As it was given to slam_.
  std::optional<slam6d::Pose3> T_slam_odom_;  // Where odometry began anew, or the start was told.

  mutable std::mutex mutex_;  // Guards what follows.
  std::optional<slam6d::Pose3> T_map_start_;
  std::vector<Stop> stops_;
  std::vector<slam6d::Pose3> T_map_sensor_;
  bool is_map_new_ = false;
};

}  // namespace qwsm::team
