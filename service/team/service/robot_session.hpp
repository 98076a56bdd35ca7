// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "qwsm/correction/node_maker.hpp"
#include "qwsm/mapping/moving_bodies.hpp"
#include "qwsm/mapping/place_watch.hpp"
#include "service/team/atlas/map_merger.hpp"
#include "service/team/atlas/team_atlas.hpp"
#include "service/team/service/contested_tracker.hpp"
#include "service/team/session/correction_easing.hpp"
#include "service/team/session/session_intake.hpp"
#include "service/team/session/session_options.hpp"
#include "service/team/session/worker_pool.hpp"
#include "service/team/sinks/sink_list.hpp"
#include "service/team/sinks/team_sink.hpp"

namespace qwsm::team {

/// What a service gives a session that it keeps.
struct SessionContext {
  std::string service;  ///< Service's name in the keys of the robot's relevant scans.
  TeamAtlas& atlas;
  MapMerger& merger;
  const SinkList<TeamSink>& sinks;
  std::optional<UncertainPose2> start;  ///< Where the robot starts if nothing better is known.
  /// Readings so near to a teammate are left out, in metres; see TeamOptions.
  double teammate_radius_m = 0.0;
  CorrectionOptions correction{};  ///< How corrections of the map reach the robot.
  /// Tells of an answer once what it says is safe.
  std::function<void(const RobotAnswer&)> report;
};

/// One robot: takes its messages from any thread and answers its scans one by one in a worker.
///
/// Where it starts: as told; else where it was last, if the map has scans of it; else as
/// configured; else, where the map is empty, at the origin of its odometry. Where none of these
/// tells, it begins a component of the map, in which it is answered until it is found in the map.
/// What it is told while it is tracked is put to a trial (ContestedTracker). A robot whose scans
/// contradict what others have mapped is lost: it begins a component, too.
class RobotSession final : public Lane {
 public:
  using Kind = Planar;

  RobotSession(std::string name,
               const SessionOptions& options,
               const MapperOptions& mapper,
               SessionContext context);

  const std::string& name() const { return intake_.name(); }
  /// The intake that takes the robot's messages.
  SessionIntake<Planar>& intake() { return intake_; }

  /// Takes up somebody's word on where the robot is now.
  void PlaceAt(const UncertainPose2& map_robot);

  std::optional<Time> ReadyAt() const override { return intake_.ReadyAt(); }
  void RunOne() override;

 private:
  using Work = SessionIntake<Planar>::Work;

  ContestedTracker::Tracked Track(const Work& work,
                                  const Observation& observation,
                                  const std::optional<Pose2>& claimed_mounting);
  void Answer(Work& work, const std::optional<Pose2>& claimed_mounting);
  TeamMap::State::View FollowCorrections();
  bool IsLost(const ScanMap& map, ContestedTracker::Tracked& tracked);
  bool IsWatched(const ScanMap& map) const;
  bool Counts(ScanId scan) const;
  MappingStep AsTold(MappingStep step) const;
  void Extend(ContestedTracker::Tracked& tracked);
  void ExtendWith(TeamScan& scan);
  std::optional<RelevantPlace<Planar>> LastRelevantPlace() const;
  void Place();
  void TakeUp(const UncertainPose2& told);
  bool IsApart() const;
  std::string ComponentName() const { return IsApart() ? component_.name : std::string(); }
  void BeginComponent();
  void LoseIt();
  void BeginAnewAt(const UncertainPose2& map_robot);
  void TellWhatIsSeen(const MappingStep& step, std::span<const ScanPoint> points);
  void HideTeammates(Work& work);
  void HideUnplacedRobots(Work& work);
  void TellNews(ContestedTracker::News news);
  SessionCounts Note(const Work& work,
                     const ContestedTracker::Tracked& tracked,
                     std::chrono::nanoseconds matching);

  const SessionContext context_;
  const RobotEvents events_;
  SessionIntake<Planar> intake_;

  mutable std::mutex mutex_;  // Guards what follows.
  std::optional<UncertainPose2> initial_pose_;

  // The worker alone uses these.
  ContestedTracker tracker_;
  PlaceWatch watch_;
  MovingBodies bodies_;
  NodeMaker nodes_;
  CorrectionEasing easing_;
  MapComponent component_;  // That the tracker's poses are in.
  MapVersion version_;      // Of its map.
  // The last scan that has extended it.
  struct LastRelevant {
    ScanKey key;
    Timestamp stamp{};
  };
  std::optional<LastRelevant> last_relevant_;
  bool is_placed_ = false;
  bool is_new_start_ = false;  // Nothing ties the next relevant scan to the one before.
  std::optional<Pose2> T_odom_last_;
  std::uint64_t sequence_ = 0;
};

}  // namespace qwsm::team
