// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/team/path_in_map.hpp"

#include <cstddef>
#include <iterator>

namespace qwsm::pipeline {
namespace {

using Motions = std::map<Timestamp, Pose2>;

// How far each relevant scan of the stretch has gone since then, of those that the map has.
Motions MotionsOf(const AnsweredStretch& stretch, const ScansInMap& now) {
  Motions T_now_then;
  for (const StampedPose2& scan : stretch.relevant) {
    const auto place = now.T_map_robot.find(scan.stamp);
    if (place == now.T_map_robot.end()) continue;
    T_now_then[scan.stamp] = place->second * scan.T_map_robot.Inverse();
  }
  return T_now_then;
}

// @pre there is one
const Pose2& NearestInTime(Timestamp stamp, const Motions& motions) {
  const auto after = motions.lower_bound(stamp);
  if (after == motions.begin()) return after->second;
  const auto before = std::prev(after);
  const bool is_before = after == motions.end() || stamp - before->first < after->first - stamp;
  return is_before ? before->second : after->second;
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
    const Motions T_now_then = is_now ? Motions() : MotionsOf(stretches[i], now);
    const bool is_last = i + 1 == stretches.size();
    for (; pose != answered.end() && (is_last || pose->stamp < stretches[i + 1].since); ++pose) {
      if (!is_now && T_now_then.empty()) continue;
      path.push_back(*pose);
      if (is_now) continue;
      const UncertainPose2 now_then{.T_a_b = NearestInTime(pose->stamp, T_now_then)};
      path.back().map_robot = now_then * pose->map_robot;
    }
  }
  return path;
}

}  // namespace qwsm::pipeline
