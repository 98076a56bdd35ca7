// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <span>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/match_result.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Why odometry may have failed since the last scan.
struct OdometryDoubt {
  bool may_have_begun_anew = false;
  bool is_surprising = false;  ///< It tells of a motion that nobody expects.
  bool is_impossible = false;  ///< There was no time to drive it.
};

/// Whether no robot drives so far, or turns so much, in the time.
bool IsTooFast(const Pose2& motion, std::chrono::duration<double> time);

/// Weighs whether odometry has failed since the last scan, by what the map tells of this one.
class OdometryFailure {
 public:
  /// @param map, points, by_odometry: outlive this. The last is where the scan was found near
  ///   where odometry has the robot.
  OdometryFailure(const ScanMap& map,
                  std::span<const ScanPoint> points,
                  const MatchResult& by_odometry,
                  const OdometryDoubt& doubt)
      : map_(map), points_(points), by_odometry_(by_odometry), doubt_(doubt) {}

  /// Whether it is worth while to look elsewhere.
  bool IsPossible() const;
  /// How much of the scan has to be explained elsewhere to show that odometry has failed.
  double LeastToShow() const;
  /// Whether odometry has failed. @param other where the scan was found without it.
  bool IsShownBy(const MatchResult& other) const;

 private:
  bool HasJumped() const { return doubt_.is_surprising && doubt_.is_impossible; }
  bool IsCalledBack() const;

  const ScanMap& map_;
  std::span<const ScanPoint> points_;
  const MatchResult& by_odometry_;
  OdometryDoubt doubt_;
};

}  // namespace qwsm
