// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/match_result.hpp"
#include "qwsm/sensor/scan_points.hpp"

namespace qwsm {

/// Weighs whether odometry has failed since the last scan, by what the map tells of this one.
class OdometryFailure {
 public:
  /// @param map, points, by_odometry: outlive this. The last is where the scan was found near
  ///   where odometry has the robot.
  /// @param is_suspect whether odometry may have begun anew since the last scan.
  OdometryFailure(const ScanMap& map,
                  std::span<const ScanPoint> points,
                  const MatchResult& by_odometry,
                  bool is_suspect)
      : map_(map), points_(points), by_odometry_(by_odometry), is_suspect_(is_suspect) {}

  /// Whether it is worth while to look elsewhere.
  /// @param is_surprising whether odometry tells of a motion that nobody expects.
  bool IsPossible(bool is_surprising) const;
  /// How much of the scan has to be explained elsewhere to show that odometry has failed.
  double LeastToShow() const;
  /// Whether odometry has failed. @param other where the scan was found without it.
  bool IsShownBy(const MatchResult& other) const;

 private:
  const ScanMap& map_;
  std::span<const ScanPoint> points_;
  const MatchResult& by_odometry_;
  bool is_suspect_;
};

}  // namespace qwsm
