// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/mapping/place_finder.hpp"

namespace qwsm {

/// Follows a robot that is lost through a map of its own, and looks for it in the map that it is
/// lost from.
class LostRobot {
 public:
  explicit LostRobot(const MapperOptions& options);

  /// Answers a scan in the frame of the robot's own, which begins with its first scan.
  MappingStep Follow(const Observation& observation);
  /// Looks for the robot in a map. @param step the answer to the scan.
  void LookFor(const ScanMap& map, const LaserScan& scan, const MappingStep& step);

  /// Forgets what is known of the robot's place, but not what was mapped.
  void LookAnew() { finder_ = PlaceFinder(local_.options()); }

  const PlaceBelief& belief() const { return finder_.belief(); }
  /// Where it was in the frame of its own at the last look, which the belief is about.
  const std::optional<Pose2>& T_local_looked() const { return finder_.T_local_looked(); }
  bool is_found() const { return belief().verdict == PlaceVerdict::kFound; }
  /// Where in the map the robot is. @pre is_found()
  const UncertainPose2& map_found() const { return belief().places.front().map_robot; }
  /// What was mapped while it was lost.
  const Mapper& local() const { return local_; }
  /// The frame of its own, for a robot that is there at its last scan.
  UncertainPose2 FrameFor(const UncertainPose2& map_robot) const;

 private:
  Mapper local_;
  PlaceFinder finder_;
};

/// An answer as it is told of a robot that is lost.
MappingStep AsLost(MappingStep step, const PlaceBelief& belief);

}  // namespace qwsm
