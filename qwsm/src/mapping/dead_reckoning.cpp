// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/dead_reckoning.hpp"

#include "qwsm/geometry/frame_covariance.hpp"

namespace qwsm {
namespace {

constexpr int kScans = 10;
constexpr double kFarChi2 = 30.7;  // Of three degrees of freedom: once in a million.

void GoOn(std::optional<UncertainPose2>& map_robot, const UncertainPose2& last_robot) {
  if (map_robot) map_robot = *map_robot * last_robot;
}

void MoveTo(std::optional<UncertainPose2>& map_robot, const UncertainPose2& new_old) {
  if (map_robot) map_robot = new_old * *map_robot;
}

}  // namespace

std::optional<UncertainPose2> DeadReckoning::Predict(const UncertainPose2& last_robot) const {
  if (!map_robot_) return std::nullopt;
  return *map_robot_ * last_robot;
}

void DeadReckoning::Follow(const UncertainPose2& last_robot, const UncertainPose2& found) {
  GoOn(map_robot_, last_robot);
  GoOn(map_robot_of_next_, last_robot);
  if (map_robot_of_next_ && ++scans_of_next_ < kScans) return;
  map_robot_ = map_robot_of_next_;
  map_robot_of_next_ = found;
  scans_of_next_ = 0;
}

void DeadReckoning::Clear() { *this = {}; }

void DeadReckoning::Move(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  MoveTo(map_robot_, new_old);
  MoveTo(map_robot_of_next_, new_old);
}

bool IsFarFrom(const UncertainPose2& expected, const UncertainPose2& found) {
  return SquaredMahalanobisDistance(expected, found) > kFarChi2;
}

}  // namespace qwsm
