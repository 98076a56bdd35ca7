// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/session/odometry_buffer.hpp"

#include <algorithm>
#include <iterator>

#include "qwsm/geometry/position.hpp"
#include "slam6d/geometry/position.hpp"

namespace qwsm::team {
namespace {

// On the straight line from a to b, the heading along the shorter turn; beyond b for share > 1.
Pose2 Interpolate(const Pose2& a, const Pose2& b, double share) {
  return {a.x_m + share * (b.x_m - a.x_m),
          a.y_m + share * (b.y_m - a.y_m),
          NormalizeAngle(a.theta_rad + share * NormalizeAngle(b.theta_rad - a.theta_rad))};
}

slam6d::Pose3 Interpolate(const slam6d::Pose3& a, const slam6d::Pose3& b, double share) {
  const Eigen::Vector3d turn_rad =
      slam6d::RotationVector(slam6d::NearestRotation(a.rotation.transpose() * b.rotation));
  return {.rotation = a.rotation * slam6d::RotationFromVector(share * turn_rad),
          .translation_m = a.translation_m + share * (b.translation_m - a.translation_m)};
}

double Seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

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
std::optional<Pose> OdometryBuffer<Pose>::At(Timestamp stamp) const {
  const auto after = std::ranges::lower_bound(readings_, stamp, {}, &Reading::stamp);
  if (after != readings_.end() && after->stamp == stamp) return after->T_odom_robot;
  if (after == readings_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after != readings_.end()) {
    if (after->stamp - before->stamp > kMaxGap) return std::nullopt;
    return Interpolate(before->T_odom_robot,
                       after->T_odom_robot,
                       Seconds(stamp - before->stamp) / Seconds(after->stamp - before->stamp));
  }
  if (stamp - before->stamp > kMaxLead) return std::nullopt;
  if (before == readings_.begin()) return before->T_odom_robot;
  const auto earlier = std::prev(before);
  const auto step = before->stamp - earlier->stamp;
  if (step > kMaxGap) return before->T_odom_robot;
  return Interpolate(earlier->T_odom_robot,
                     before->T_odom_robot,
                     1.0 + Seconds(stamp - before->stamp) / Seconds(step));
}

template class OdometryBuffer<Pose2>;
template class OdometryBuffer<slam6d::Pose3>;

}  // namespace qwsm::team
