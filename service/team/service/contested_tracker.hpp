// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "service/team/service/tracking_trial.hpp"

namespace qwsm::team {

/// The tracker of a robot of which anybody may say where it is and where its laser sits. What goes
/// against how it is tracked is put to the trial of its scans:
/// * Where it was told to be it is from then on, but the map is not extended until its scans agree;
///   it goes back to where it was tracked if they contradict.
/// * Its laser sits where it did, until its scans agree better with what is claimed.
class ContestedTracker {
 public:
  /// What a scan has brought to light.
  enum class News {
    kNone,
    kPlaceContradicted,  ///< The robot is back where it was tracked, not where it was told to be.
    /// Somebody says that the robot's laser sits elsewhere: its scans will tell.
    kMountingContested,
    kMountingRefuted,  ///< The laser does not sit where it was claimed to.
    kMountingChanged,  ///< The laser sits where it was claimed to.
  };

  struct Tracked {
    MappingStep step;
    std::vector<ScanPoint> points;     ///< Of the scan, as RobotTracker gives them.
    std::vector<TeamScan> relevant{};  ///< Scans to extend the map with; they have no keys yet.
    News news = News::kNone;
  };

  explicit ContestedTracker(const MapperOptions& options) : tracker_(options) {}

  /// Tells where the robot is, beyond dispute.
  void PlaceAt(const UncertainPose2& map_robot, const std::optional<Pose2>& T_odom_robot = {});
  /// Takes up somebody's word on where the robot is, while it is tracked.
  void PlaceAsTold(const UncertainPose2& map_robot);
  /// Expects that odometry may have begun anew; see RobotTracker.
  void SuspectOdometryReset();
  /// Follows a correction of the map; see RobotTracker.
  void FollowCorrection(const UncertainPose2& map_robot);

  /// Settles where the laser of a scan sits. @param claimed where somebody says that it does, other
  /// than the scan. @param is_tracked else the claim is taken. @return the claim if it is open.
  std::optional<Pose2> Mount(LaserScan& scan, const std::optional<Pose2>& claimed, bool is_tracked);

  /// Finds where the robot is. @param claimed what Mount() returned.
  Tracked Track(const ScanMap& map,
                const Observation& observation,
                const std::optional<Pose2>& claimed);

  const UncertainPose2& map_robot() const { return tracker_.map_robot(); }
  /// Whether a trial is on about where the robot is.
  bool is_place_contested() const { return trial_ && !claimed_; }

 private:
  /// A claim on the laser's place that was settled.
  struct Mounting {
    Pose2 T_robot_laser;
    Pose2 claimed;
    bool is_believed = false;
  };

  bool Contest(const std::optional<Pose2>& claimed, const Pose2& T_robot_laser);
  TrackingTrial::Verdict Hear(const ScanMap& map,
                              const Observation& observation,
                              const MappingStep& step);
  News Settle(bool is_rival_right, Tracked& tracked);

  RobotTracker tracker_;
  double explained_share_ = 0.0;  // Share of the last scan that the map explains.
  std::optional<TrackingTrial> trial_;
  // The laser's place that the trial is about; nothing where it is about the robot's.
  std::optional<Pose2> claimed_;
  Pose2 T_robot_laser_;  // Of the laser that is claimed to sit there.
  std::vector<Mounting> settled_;
};

}  // namespace qwsm::team
