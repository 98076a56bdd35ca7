// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "qwsm/mapping/dead_reckoning.hpp"
#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/gyro_odometry.hpp"
#include "qwsm/mapping/laser_turns.hpp"
#include "qwsm/mapping/local_submap.hpp"
#include "qwsm/mapping/loop_detector.hpp"
#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/motion_model.hpp"
#include "qwsm/mapping/moving_bodies.hpp"
#include "qwsm/mapping/observation.hpp"
#include "qwsm/mapping/odometry_calibration.hpp"
#include "qwsm/mapping/paths_apart.hpp"
#include "qwsm/mapping/scan_locator.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/mapping/slip_estimator.hpp"
#include "qwsm/mapping/tracked_scan.hpp"

namespace qwsm {

/// Follows one robot through a map that it does not own: several robots may share it, each with a
/// tracker of its own. The map is only read, so that trackers may work in parallel; to extend it
/// with the relevant scans is the caller's business. Deterministic; reads no clock.
///
/// Of a robot with several lasers, each scan is one more look at where it is, from where its laser
/// sits and at its own time; each laser extends the map with what it sees.
///
/// A scan whose beams have times is matched twice: the first match tells how the robot moved while
/// it was taken beside what odometry tells, and by that its beams are moved to one place anew.
class RobotTracker {
 public:
  explicit RobotTracker(const MapperOptions& options = {});

  /// Gives the initial pose of the robot, before its first scan or when it was put elsewhere.
  /// @param T_odom_robot odometry at that place, if it is known and goes on from there.
  void PlaceAt(const UncertainPose2& map_robot, const std::optional<Pose2>& T_odom_robot = {});

  /// Says that odometry may have begun anew since the last scan: at the next one the tracker
  /// believes in the motion it tells only if the scan agrees better with the map there than where
  /// the robot was.
  void SuspectOdometryReset() { is_odometry_suspect_ = true; }

  /// Follows a map that was corrected: the robot keeps its place among the surfaces around it.
  /// @param map_robot pose at the last scan in the corrected map.
  void FollowCorrection(const UncertainPose2& map_robot);

  /// Finds where the robot is. If the step is relevant, the map ought to be extended with its scan.
  TrackedScan Track(const ScanMap& map, const Observation& told);

  /// The pose at the last scan, or the one given since.
  const UncertainPose2& map_robot() const { return map_last_; }
  const MapperOptions& options() const { return options_; }

 private:
  /// What a scan tells of where it was taken, before anything is learned from it.
  struct Sighting {
    Observation observation;                    // With the scan as if the robot had stood.
    std::optional<Eigen::Vector3d> velocity{};  // By which its beams were moved for that.
    std::vector<ScanPoint> points{};
    MappingStep step{};
    std::optional<PosePrediction> last_robot{};  // Motion since the last scan, if there was one.
    bool dropped_odometry = false;
    std::optional<PathsApart> apart{};  // Where matches and odometry have the robot, if not alike.
  };

  Sighting LookTwice(const ScanMap& map,
                     const Observation& observation,
                     const std::optional<Pose2>& T_odom_robot) const;
  Sighting Look(const ScanMap& map,
                StillScan still,
                const std::optional<Pose2>& T_odom_robot,
                const std::optional<double>& gyro_rad) const;
  void Begin(Sighting& sighting) const;
  UncertainPose2 FirstPose(const Observation& observation) const;
  void Locate(const ScanMap& map, Sighting& sighting) const;
  MatchResult LocateNear(const ScanMap& map,
                         const Observation& observation,
                         std::span<const ScanPoint> points,
                         const PosePrediction& predicted) const;
  bool DropFailedOdometry(const ScanMap& map,
                          const Observation& observation,
                          std::span<const ScanPoint> points,
                          PosePrediction& last_robot,
                          MappingStep& step) const;
  const UncertainPose2& PathOfMatches() const { return apart_ ? apart_->by_match() : local_last_; }
  std::optional<PathsApart> ComparePaths(const ScanMap& map,
                                         std::span<const ScanPoint> points,
                                         const UncertainPose2& last_robot,
                                         MatchResult& match) const;
  void JudgePaths(Sighting& sighting) const;
  void Judge(const ScanMap& map,
             std::span<const ScanPoint> points,
             const Eigen::Matrix3d& motion_covariance,
             MappingStep& step) const;
  StepStatus StatusOf(const MatchResult& match) const;
  bool HasMovedOn(const LaserScan& scan,
                  std::span<const ScanPoint> points,
                  const MappingStep& step) const;
  void CloseLoop(const ScanMap& map,
                 const LaserScan& scan,
                 std::span<const ScanPoint> points,
                 MappingStep& step);
  void LearnMotion(const Sighting& sighting, std::size_t scans);
  void LeavePath();
  void Remember(const Sighting& sighting, bool has_moved_on);
  void LearnOdometry(const Sighting& sighting);
  void Extend(bool extends,
              const Observation& observation,
              std::span<const ScanPoint> points,
              MappingStep& step);

  // A relevant scan that the next one will tell more about.
  struct HeldScan {
    Observation observation;
    UncertainPose2 map_robot;
    UncertainPose2 local;                 // The same, as uncertain as relative to the map around.
    std::optional<Pose2> T_wheels_robot;  // Odometry as it was told.
  };

  MapperOptions options_;
  GyroOdometry gyro_;
  OdometryCalibration calibration_;
  SlipEstimator slip_;
  MotionModel motion_;
  ScanLocator locator_;
  DeadReckoning dead_reckoning_;
  std::optional<PathsApart> apart_;  // Until it is known which path is right.
  LaserTurns lasers_;
  LoopDetector loop_detector_;
  LocalSubmap submap_;
  FreeSpace seen_free_;
  MovingBodies bodies_;
  UncertainPose2 map_last_;    // Pose at the last scan, or as given since.
  UncertainPose2 local_last_;  // The same, as uncertain as relative to the map around.
  std::optional<HeldScan> held_;
  bool has_initial_pose_ = false;        // The last pose was given, not found.
  bool stands_at_initial_pose_ = false;  // And the next scan is taken there.
  bool is_odometry_suspect_ = false;     // It may have begun anew since the last scan.
};

}  // namespace qwsm
