// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/path_in_map.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include "qwsm/metrics/pose_lookup.hpp"

namespace qwsm::pipeline {
namespace {

// How far each relevant scan of the stretch has gone since then, of those that the map has.
Trajectory MotionsOf(const AnsweredStretch& stretch, const ScansInMap& now) {
  Trajectory T_now_then;
  for (const StampedPose2& scan : stretch.relevant) {
    const auto place = now.T_map_robot.find(scan.stamp);
    if (place == now.T_map_robot.end()) continue;
    T_now_then.push_back(
        {.stamp = scan.stamp, .T_map_robot = place->second * scan.T_map_robot.Inverse()});
  }
  return SortedByStamp(std::move(T_now_then));
}

// The pose where the map is now. None where the map has no scan that it could be beside.
std::optional<io::PathPose> Moved(io::PathPose pose, const Trajectory& T_now_then) {
  const auto beside = NearestIndex(T_now_then, pose.stamp, Timestamp::max());
  if (!beside) return std::nullopt;
  pose.map_robot = UncertainPose2{.T_a_b = T_now_then[*beside].T_map_robot} * pose.map_robot;
  return pose;
}

}  // namespace

std::vector<io::PathPose> PathInMap(std::span<const io::PathPose> answered,
                                    std::span<const AnsweredStretch> stretches,
                                    const ScansInMap& now) {
  std::vector<io::PathPose> path;
  path.reserve(answered.size());
  auto pose = answered.begin();
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const bool is_now = stretches[i].version == now.version;
    const Trajectory T_now_then = is_now ? Trajectory() : MotionsOf(stretches[i], now);
    const bool is_last = i + 1 == stretches.size();
    for (; pose != answered.end() && (is_last || pose->stamp < stretches[i + 1].since); ++pose) {
      const std::optional<io::PathPose> placed = is_now ? *pose : Moved(*pose, T_now_then);
      if (placed) path.push_back(*placed);
    }
  }
  return path;
}

}  // namespace qwsm::pipeline
