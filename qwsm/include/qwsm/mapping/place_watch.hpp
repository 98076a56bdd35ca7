// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "qwsm/mapping/free_space.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/mapping/view_break.hpp"

namespace qwsm {

/// What is thought of the place where a robot is tracked.
enum class PlaceDoubt : std::uint8_t {
  kNone,
  kInDoubt,  ///< What the robot sees speaks against it, and may do so by chance.
  kLost,     ///< The robot is somewhere else, beyond doubt.
};

/// Watches whether a robot is where it is tracked. A robot that was carried elsewhere sees what the
/// map contradicts, look after look: a sequential test (Page 1954), in which what speaks for its
/// place is not saved up for later. Every half metre counts once, so that who stands in the way of
/// a waiting robot is no evidence, and no look suffices.
///
/// Where the map does not reach, nothing contradicts. But no robot leaves a map from one scan to
/// the next: where the map explained what it saw a moment ago, and does not any more, that speaks
/// against the place, too, until the map explains it again.
class PlaceWatch {
 public:
  /// Whose map it is: one that was made before, or one that grows by what the robot sees.
  enum class MapKind : std::uint8_t { kMadeBefore, kGrowing };

  explicit PlaceWatch(const FreeSpaceOptions& options, MapKind map = MapKind::kMadeBefore)
      : map_kind_(map), evidence_(options) {}

  /// Weighs a scan that was tracked. @param points of the scan.
  /// @param counts scans of the map of which it is known where they were taken; all, if it is none.
  PlaceDoubt Look(const ScanMap& map,
                  std::span<const ScanPoint> points,
                  const MappingStep& step,
                  const PlaceEvidence::Counts& counts = {});

  /// Says that the robot was placed anew in the same map.
  void BeginAnew();
  /// Says that the map was corrected: its scans are elsewhere now.
  void FollowCorrection();
  /// Says that the map is another one, of other scans.
  void BeginInAnotherMap();

 private:
  void NoteBreak(const MappingStep& step);
  bool IsDue(const Pose2& T_map_robot) const;
  double NatsOf(const PlaceFit& fit) const;
  PlaceDoubt Doubt() const;

  MapKind map_kind_;
  PlaceEvidence evidence_;
  double nats_ = 0.0;                       // For the place where the robot is tracked, 0 at most.
  std::optional<Pose2> T_map_looked_;       // Where a scan was weighed last.
  ViewBreak view_;
  std::optional<double> explained_before_;  // That the map explained a moment ago, and not since.
};

}  // namespace qwsm
