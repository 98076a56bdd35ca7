// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/scans/team_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qwsm::team {
namespace {

bool IsNear(const Pose2& pose) {
  return IsFinite(pose) && std::abs(pose.x_m) < kMaxDistance_m &&
         std::abs(pose.y_m) < kMaxDistance_m;
}

}  // namespace

std::string_view ObjectionTo(const LaserScan& scan) {
  const LaserGeometry& geometry = scan.geometry;
  if (scan.ranges_m.empty()) return "the scan has no beams";
  if (scan.size() > kMaxBeams) return "the scan has more than 100000 beams";
  const double turn_rad = scan.size() > 1 ? std::abs(geometry.Bearing(1) - geometry.Bearing(0)) : 0;
  if (!std::isfinite(geometry.first_bearing_rad) ||
      !(turn_rad * static_cast<double>(scan.size() - 1) <= 4.0 * std::numbers::pi)) {
    return "the scan's bearings are not finite, or go round more than twice";
  }
  if (!(geometry.range_min_m >= 0.0F && geometry.range_min_m < geometry.range_max_m)) {
    return "the scan's range limits are not 0 <= minimum < maximum";
  }
  if (geometry.range_max_m > kMaxRange_m) return "the scan's range maximum is above 1 km";
  if (!IsNear(geometry.T_robot_laser)) return "the laser's mounting is not finite";
  return {};
}

std::string_view ObjectionTo(const UncertainPose2& pose) {
  if (!IsNear(pose.T_a_b)) return "the pose is not finite, or more than 20 km away";
  if (!pose.covariance.allFinite() || pose.covariance.diagonal().minCoeff() < 0.0) {
    return "the covariance is not finite, or its diagonal is negative";
  }
  return {};
}

std::string_view ObjectionTo(const TeamScan& scan) {
  const std::string_view objection = ObjectionTo(scan.scan);
  return objection.empty() ? ObjectionTo(scan.map_robot) : objection;
}

}  // namespace qwsm::team
