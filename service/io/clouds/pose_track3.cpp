// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/clouds/pose_track3.hpp"

#include <algorithm>

#include "service/io/logs/odometry_between.hpp"

namespace slam6d::io {

void PoseTrack3::Sort() { std::ranges::stable_sort(poses_, {}, &Entry::stamp); }

std::optional<Pose3> PoseTrack3::At(qwsm::Timestamp stamp) const {
  const auto after = std::ranges::upper_bound(poses_, stamp, {}, &Entry::stamp);
  const bool has_before = after != poses_.begin();
  const bool has_after = after != poses_.end();
  const auto before = has_before ? after - 1 : after;
  if (has_before && before->stamp == stamp) return before->pose;
  if (has_before && has_after && after->stamp - before->stamp <= qwsm::io::kLongestGap) {
    const double share = static_cast<double>((stamp - before->stamp).count()) /
                         static_cast<double>((after->stamp - before->stamp).count());
    return Between(before->pose, after->pose, share);
  }
  if (has_before && stamp - before->stamp <= qwsm::io::kLongestReach) return before->pose;
  if (has_after && after->stamp - stamp <= qwsm::io::kLongestReach) return after->pose;
  return std::nullopt;
}

}  // namespace slam6d::io
