// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/observation.hpp"
#include "qwsm/mapping/robot_tracker.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// Incremental mapping (Visser et al. 2009, sections 3 and 4) by one robot: each scan is matched
/// with the union of all relevant scans before it, and relevant ones extend the map. What was found
/// is never corrected by it afterwards. Deterministic; reads no clock.
class Mapper {
 public:
  explicit Mapper(const MapperOptions& options = {});
  /// Goes on in a map that was made before, near `map_robot`.
  Mapper(const MapperOptions& options, ScanMap map, const UncertainPose2& map_robot);

  MappingStep Process(const Observation& observation);

  /// Goes on in a map of the same scans that was corrected.
  /// @param map_robot pose at the last scan in the corrected map.
  void GoOnIn(ScanMap corrected, const UncertainPose2& map_robot);

  /// Places the robot anew: the next scan is taken there.
  void PlaceAt(const UncertainPose2& map_robot);
  /// Extends the map with a scan that was answered by somebody else.
  void Extend(const LaserScan& scan, const UncertainPose2& map_robot);
  /// Takes scans out of the map, as if they had never been inserted. @param first of them.
  void ForgetSince(ScanId first);

  /// Forgets the points of the map, which are most of its memory, but not its scans: for when no
  /// scan follows.
  void ForgetPoints() { map_.ForgetPoints(); }

  const ScanMap& map() const { return map_; }
  /// The pose at the last scan.
  const UncertainPose2& map_robot() const { return tracker_.map_robot(); }
  const MapperOptions& options() const { return tracker_.options(); }

 private:
  RobotTracker tracker_;
  ScanMap map_;
};

}  // namespace qwsm
