// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "service/team/scans/scan_key.hpp"
#include "service/team/service/cloud_options.hpp"
#include "service/team/session/session_intake.hpp"
#include "service/team/sinks/cloud_sink.hpp"
#include "service/team/sinks/sink_list.hpp"

namespace qwsm::team {

/// What a service gives a session for clouds that it keeps.
struct CloudContext {
  const slam6d::LoopCloser& closer;
  const SinkList<CloudSink>& sinks;
  /// Puts a scan that has been registered into the journal.
  std::function<void(const KeptCloud&)> keep;
  /// Tells of an answer once what it says is safe.
  std::function<void(const CloudAnswer&)> report;
};

/// One robot with a 3D scanner: takes its messages from any thread, registers its scans one by one
/// in a worker, each into the robot's own model.
///
/// The model begins where the robot is told to be, else where its odometry has it. Where odometry
/// is missing or begins anew, the motion before goes on. Scans from the journal are registered once
/// more, before all others.
class CloudSession final : public Lane {
 public:
  using Kind = Spatial;

  CloudSession(std::string name,
               const CloudTeamOptions& options,
               const slam6d::SlamOptions& slam,
               const CloudContext& context);

  const std::string& name() const { return intake_.name(); }
  /// The intake that takes the robot's messages.
  SessionIntake<Spatial>& intake() { return intake_; }

  /// Takes a scan of the journal, to be registered before those that come.
  /// @pre no worker runs yet.
  void Restore(KeptCloud kept);
  /// Tells where the robot is now; counts until its first scan.
  void PlaceAt(const slam6d::UncertainPose3& map_robot);

  std::optional<Time> ReadyAt() const override;
  void RunOne() override;

  /// The model, if it has changed since the last call.
  std::optional<CloudMap> NewMap();
  /// Fits all scans to each other. @pre no worker runs.
  slam6d::RefinementResult Refine() { return slam_.Refine(); }
  /// Number of scans of the model, and of their points, thinned.
  MapStatus ModelStatus() const;

 private:
  using Work = SessionIntake<Spatial>::Work;

  /// The part of a scan that is kept for the merged cloud.
  struct Stop {
    Timestamp stamp{};
    slam6d::Pose3 T_robot_sensor;
    std::shared_ptr<const slam6d::PointCloud> thinned;
  };

  bool RestoreOne();
  slam6d::Pose3 EstimateSensor(const Work& work);
  slam6d::Pose3 EstimateFirst(const Work& work);
  /// Registers the scan, beginning at T_odom_sensor_last_.
  CloudAnswer Register(const std::shared_ptr<const CloudScan>& scan);
  void Draw(const CloudScan& scan);
  SessionCounts Note(const Work& work, const CloudAnswer& answer);

  const slam6d::ReductionOptions thinning_;
  const CloudContext context_;
  const RobotEvents events_;
  SessionIntake<Spatial> intake_;

  // The worker alone uses these.
  slam6d::Slam slam_;
  // Whether it was told that somebody claims another place of the scanner.
  bool is_claim_told_ = false;
  slam6d::Pose3 T_odom_sensor_last_;          // Odometry as it was given to slam_ last.
  std::optional<slam6d::Pose3> T_slam_odom_;  // Where odometry began anew, or the start was told.
  std::uint64_t sequence_ = SequenceOfNow();

  mutable std::mutex mutex_;  // Guards what follows.
  std::deque<KeptCloud> to_restore_;
  std::optional<slam6d::Pose3> T_map_start_;
  std::vector<Stop> stops_;
  std::vector<slam6d::Pose3> T_map_sensor_;
  bool is_map_new_ = false;
};

}  // namespace qwsm::team
