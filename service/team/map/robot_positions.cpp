// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/robot_positions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace qwsm::team {

void RobotPositions::Report(std::string_view robot, const Eigen::Vector2d& p_map_m, Time now) {
  const std::lock_guard lock(mutex_);
  const auto known = by_robot_.find(robot);
  Sighting& sighting = known != by_robot_.end() ? known->second : by_robot_[std::string(robot)];
  sighting = {.p_map_m = p_map_m, .at = now};
}

std::vector<Eigen::Vector2d> RobotPositions::OthersThan(std::string_view robot, Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<Eigen::Vector2d> positions_map_m;
  for (const auto& [name, sighting] : by_robot_) {
    if (name != robot && now - sighting.at < kFresh) positions_map_m.push_back(sighting.p_map_m);
  }
  return positions_map_m;
}

void HideRobots(std::span<const Eigen::Vector2d> positions_map_m,
                double radius_m,
                const Pose2& T_map_robot,
                LaserScan& scan) {
  if (positions_map_m.empty()) return;
  const Pose2 T_map_laser = T_map_robot * scan.geometry.T_robot_laser;
  // By distance: a beam ends at none that is much nearer or farther than its range.
  std::vector<std::pair<double, Eigen::Vector2d>> robots;
  for (const Eigen::Vector2d& p_map_m : positions_map_m) {
    robots.emplace_back((p_map_m - T_map_laser.translation_m()).norm(), p_map_m);
  }
  const auto distance_of = [](const auto& robot) { return robot.first; };
  std::ranges::sort(robots, {}, distance_of);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (StateOf(scan.ranges_m[beam], scan.geometry) != BeamState::kHit) continue;
    const double range_m = static_cast<double>(scan.ranges_m[beam]);
    const auto first = std::ranges::lower_bound(robots, range_m - radius_m, {}, distance_of);
    const auto last = std::ranges::upper_bound(robots, range_m + radius_m, {}, distance_of);
    if (first == last) continue;
    const double bearing_rad = scan.geometry.Bearing(beam);
    const Eigen::Vector2d end_map_m =
        T_map_laser *
        Eigen::Vector2d(range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad));
    const bool is_robot = std::any_of(first, last, [&](const auto& robot) {
      return (end_map_m - robot.second).squaredNorm() < radius_m * radius_m;
    });
    if (is_robot) scan.ranges_m[beam] = std::numeric_limits<float>::quiet_NaN();
  }
}

}  // namespace qwsm::team
