// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "qwsm/mapping/mapper_options.hpp"
#include "qwsm/mapping/mapping_step.hpp"
#include "qwsm/mapping/place_evidence.hpp"
#include "qwsm/mapping/place_watch.hpp"
#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/mapping/view_break.hpp"

namespace qwsm {

/// Watches whether a robot that makes its map itself was carried: its wheels did not turn, or its
/// log has a gap. Then it sees something else from one scan to the next, and what it sees from
/// there on contradicts what it had mapped before, and that contradicts what it sees.
///
/// What it has mapped since explains its scans wherever it is, and where it has not been before
/// nothing does: so the map as it was before bears witness alone, and what neither it nor the scan
/// looked at counts for nothing. A robot that drifts contradicts its map as well, which loops mend:
/// without a break of the view nothing is asked, and before a robot is called lost it is sought
/// where it may have drifted. Where a robot was found that was lost, the same is asked for as long:
/// what comes into view there must be what the map foretells.
class CarryWatch {
 public:
  explicit CarryWatch(const MapperOptions& options)
      : options_(options), evidence_(options.free_space) {}

  /// Weighs a scan that was tracked. @param map after the scan has extended it, if it did.
  PlaceDoubt Look(const ScanMap& map, const LaserScan& scan, const MappingStep& step);

  /// Whether the view broke and it is not known yet why, or a place has yet to prove true.
  bool is_asking() const { return question_.has_value(); }
  /// Whether it is asked of a place where the robot was found.
  bool is_asking_of_found_place() const { return question_ && question_->is_of_found_place; }
  /// How many scans the map had when the view broke, or the robot was found. @pre is_asking()
  std::size_t scans_before() const { return question_->scans_before; }

  /// Says that the robot was placed anew, or that the map is another one.
  void BeginAnew(const ScanMap& map);
  /// Follows a map that was corrected where the robot is. @pre it is of the same scans
  void Move(const Pose2& T_new_old);
  /// Says that the robot was found. @param scans_before that the map had before what was seen by the
  /// robot while it was lost.
  void AskOfFoundPlace(const ScanMap& map, std::size_t scans_before);

 private:
  struct Question {
    std::size_t scans_before = 0;
    bool is_of_found_place = false;
    double explained_before = 0.0;
    double nats = 0.0;  // For the place where the robot is tracked, 0 at most.
    int looks = 0;
    Pose2 T_map_reckoned{};               // By odometry, from where the robot was before.
    std::optional<Pose2> T_map_looked{};  // Where a scan was weighed last.
  };

  bool IsAsked(const ScanMap& map, const LaserScan& scan, const MappingStep& step);
  bool IsAnswered(const ScanMap& map, const ScanAtPlace& placed) const;
  bool IsDue(const Pose2& T_map_robot) const;
  bool HasDrifted(const ScanMap& map, const LaserScan& scan, const UncertainPose2& map_robot) const;
  void Close();

  MapperOptions options_;
  PlaceEvidence evidence_;
  ViewBreak view_;
  std::size_t scans_ = 0;  // Of the map, after the last scan.
  Pose2 T_map_last_;       // Where that was taken.
  std::optional<Question> question_;
};

}  // namespace qwsm
