// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/matching/match_result.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// A scan where one of two paths has brought the robot.
struct PathEnd {
  const MatchResult& match;
  double explained_before = 0.0;  ///< Share that shows what the map had before the paths parted.
};

/// Where a robot is by its matches, and where by an odometry that has proved to be better than
/// that: in a corridor somebody who walks there is all that tells of the way along it, and takes
/// the robot with him; or the wheels have slipped. The scans decide, one after another (the
/// sequential probability ratio test of Wald 1945): each speaks for the pose where it shows more of
/// the map as that was before, if it shows of that, and against the matches if for these the wheels
/// have slipped once more.
class PathsApart {
 public:
  /// Weighs the next scan at both poses.
  /// @param points of the scan.
  /// @param before the paths until then, if they were apart.
  /// @param expected where the matches' path was to go on, as uncertain as odometry has proved to
  ///   be.
  /// @param max_moving_share of the points that may be of somebody who walks.
  /// @return nothing if the matches alone can be right: at the other pose the scan shows less of the
  ///   map, and too little of it, or too much that would have moved.
  static std::optional<PathsApart> Weigh(std::span<const ScanPoint> points,
                                         const std::optional<PathsApart>& before,
                                         const UncertainPose2& expected,
                                         const PathEnd& by_match,
                                         const PathEnd& by_odometry,
                                         double max_moving_share);

  const UncertainPose2& by_match() const { return by_match_; }
  const UncertainPose2& by_odometry() const { return by_odometry_; }
  /// Which is the better account until now.
  bool is_by_odometry() const { return nats_for_match_ <= 0.0; }
  /// Whether it is known which one is right.
  bool is_decided() const;

  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

 private:
  UncertainPose2 by_match_;  // Both relative to the map around.
  UncertainPose2 by_odometry_;
  double nats_for_match_ = 0.0;
};

/// Share of a scan that has to be explained where odometry has the robot: less puts the match into
/// no doubt, by PathsApart::Weigh() or IsSlipTold().
double LeastToDoubt(std::span<const ScanPoint> points,
                    const MatchResult& match,
                    double max_moving_share);

/// Whether a scan alone tells that the wheels have slipped to where it was matched. A few points of
/// a wall that is new fit some other one near by.
/// @param expected as the matches have it.
/// @param by_odometry a match where odometry has the robot.
bool IsSlipTold(std::span<const ScanPoint> points,
                const UncertainPose2& expected,
                const MatchResult& match,
                const MatchResult& by_odometry);

}  // namespace qwsm
