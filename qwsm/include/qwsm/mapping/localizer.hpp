// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "qwsm/mapping/lost_robot.hpp"
#include "qwsm/mapping/place_watch.hpp"
#include "qwsm/mapping/robot_tracker.hpp"

namespace qwsm {

/// Follows a robot through a map that was made before. Where the robot is need not be known: until
/// it is found, and when the map contradicts its scans for some metres, it is lost, and its answers
/// are poses in a frame of its own. The map stays as it is, or, with `extend_map`, goes on:
/// relevant scans extend it, those of a robot that was lost as soon as it is found. Deterministic;
/// reads no clock.
class Localizer {
 public:
  /// @param start pose at the first scan, if it is known.
  Localizer(const MapperOptions& options,
            ScanMap map,
            const std::optional<UncertainPose2>& start = {});

  /// Finds where the robot is. While it is lost, status is kLost, and `map_robot` is its pose in
  /// a frame that begins where it was lost.
  MappingStep Process(const Observation& observation);

  const ScanMap& map() const { return map_; }
  bool is_lost() const { return lost_.has_value(); }
  /// What is known of the place of the robot while it is lost.
  const PlaceBelief& belief() const { return lost_ ? lost_->belief() : found_; }
  /// Where the robot that is lost was in the frame of its own at the last look, if there was one.
  std::optional<Pose2> T_local_looked() const {
    return lost_ ? lost_->T_local_looked() : std::nullopt;
  }
  /// The frame of the robot's own in which it was lost last, once it is found.
  const UncertainPose2& map_local() const { return map_local_; }

 private:
  MappingStep Search(const Observation& observation);
  MappingStep Found(const Observation& observation);
  void Extend(const TrackedScan& tracked);
  void Join(const ScanMap& local);
  void Lose();

  MapperOptions options_;
  ScanMap map_;
  RobotTracker tracker_;
  std::optional<LostRobot> lost_;
  PlaceBelief found_;  // By which it was found last.
  PlaceWatch watch_;
  UncertainPose2 map_local_;
};

}  // namespace qwsm
