// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/pose_lookup.hpp"

#include <algorithm>
#include <cassert>

namespace qwsm {
namespace {

// A pose this near in time is the pose asked for: logs are written in whole microseconds.
constexpr std::chrono::microseconds kSameMoment{1};

// The first pose that is not before `stamp`.
Trajectory::const_iterator NotBefore(const Trajectory& sorted, Timestamp stamp) {
  return std::ranges::lower_bound(sorted, stamp, {}, &StampedPose2::stamp);
}

std::optional<Pose2> PoseWithin(const StampedPose2& pose,
                                Timestamp stamp,
                                std::chrono::nanoseconds tolerance) {
  if (std::chrono::abs(pose.stamp - stamp) > tolerance) return std::nullopt;
  return pose.T_map_robot;
}

}  // namespace

Trajectory SortedByStamp(Trajectory trajectory) {
  std::ranges::stable_sort(trajectory, {}, &StampedPose2::stamp);
  return trajectory;
}

std::optional<std::size_t> NearestIndex(const Trajectory& sorted,
                                        Timestamp stamp,
                                        std::chrono::nanoseconds tolerance) {
  assert(std::ranges::is_sorted(sorted, {}, &StampedPose2::stamp));
  if (sorted.empty()) return std::nullopt;
  auto nearest = NotBefore(sorted, stamp);
  if (nearest == sorted.end()) {
    --nearest;
  } else if (nearest != sorted.begin()) {
    const auto before = std::prev(nearest);
    if (stamp - before->stamp <= nearest->stamp - stamp) nearest = before;
  }
  if (std::chrono::abs(nearest->stamp - stamp) > tolerance) return std::nullopt;
  return static_cast<std::size_t>(nearest - sorted.begin());
}

std::optional<Pose2> InterpolatedPose(const Trajectory& sorted,
                                      Timestamp stamp,
                                      std::chrono::nanoseconds tolerance) {
  assert(std::ranges::is_sorted(sorted, {}, &StampedPose2::stamp));
  if (sorted.empty()) return std::nullopt;
  const auto after = NotBefore(sorted, stamp);
  if (after == sorted.end()) return PoseWithin(sorted.back(), stamp, tolerance);
  if (after->stamp - stamp < kSameMoment) return after->T_map_robot;
  if (after == sorted.begin()) return PoseWithin(sorted.front(), stamp, tolerance);
  const auto before = std::prev(after);
  const std::chrono::duration<double> elapsed = stamp - before->stamp;
  const std::chrono::duration<double> whole = after->stamp - before->stamp;
  return Between(before->T_map_robot, after->T_map_robot, elapsed / whole);
}

}  // namespace qwsm
