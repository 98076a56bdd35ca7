// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/odometry_buffer.hpp"

#include <algorithm>
#include <iterator>

#include "qwsm/geometry/position.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::team {

template <class Pose>
bool OdometryBuffer<Pose>::Add(Timestamp stamp, const Pose& T_odom_robot) {
  if (!IsPosition(T_odom_robot)) return false;
  switch (guard_.Judge(stamp)) {
    case StampVerdict::kDuplicate:
    case StampVerdict::kWrongTime:
      return false;
    case StampVerdict::kClockReset:
      readings_.clear();
      break;
    case StampVerdict::kInOrder:
    case StampVerdict::kLate:
      break;
  }
  return Insert({.stamp = stamp, .T_odom_robot = T_odom_robot});
}

template <class Pose>
bool OdometryBuffer<Pose>::Insert(const Reading& reading) {
  const auto later = std::ranges::upper_bound(readings_, reading.stamp, {}, &Reading::stamp);
  const bool is_older_than_all = later == readings_.begin() && !readings_.empty();
  if (is_older_than_all ||
      (later != readings_.begin() && std::prev(later)->stamp == reading.stamp)) {
    return false;
  }
  readings_.insert(later, reading);
  if (readings_.size() > kCapacity) readings_.pop_front();
  return true;
}

template <class Pose>
bool OdometryBuffer<Pose>::Covers(Timestamp stamp) const {
  return !readings_.empty() && readings_.back().stamp >= stamp;
}

template <class Pose>
bool OdometryBuffer<Pose>::BeginsAfter(Timestamp stamp) const {
  return !readings_.empty() && readings_.front().stamp > stamp;
}

template <class Pose>
std::chrono::nanoseconds OdometryBuffer<Pose>::Apart(Timestamp stamp) const {
  if (readings_.empty()) return {};
  return stamp - std::clamp(stamp, readings_.front().stamp, readings_.back().stamp);
}

template <class Pose>
std::optional<Pose> OdometryBuffer<Pose>::At(Timestamp stamp) const {
  const auto after = std::ranges::lower_bound(readings_, stamp, {}, &Reading::stamp);
  if (after != readings_.end() && after->stamp == stamp) return after->T_odom_robot;
  if (after == readings_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after != readings_.end()) {
    if (after->stamp - before->stamp > kMaxGap) return std::nullopt;
    return Between(before->T_odom_robot,
                   after->T_odom_robot,
                   Seconds(stamp - before->stamp) / Seconds(after->stamp - before->stamp));
  }
  if (stamp - before->stamp > kMaxLead) return std::nullopt;
  if (before == readings_.begin()) return before->T_odom_robot;
  const auto earlier = std::prev(before);
  const auto step = before->stamp - earlier->stamp;
  if (step > kMaxGap) return before->T_odom_robot;
  return Between(earlier->T_odom_robot,
                 before->T_odom_robot,
                 1.0 + Seconds(stamp - before->stamp) / Seconds(step));
}

template class OdometryBuffer<Pose2>;
template class OdometryBuffer<slam6d::Pose3>;

}  // namespace qwsm::team
