// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/dead_reckoning.hpp"

#include <Eigen/LU>
#include <utility>

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

void DeadReckoning::Follow(const UncertainPose2& last_robot,
                           const Pose2& T_map_robot,
                           const Eigen::Matrix3d& told,
                           std::size_t scans) {
  const Eigen::Matrix3d reckoned = (map_last_ * last_robot).covariance;
  const Eigen::Matrix3d share = Eigen::Matrix3d::Identity() + reckoned * told;
  map_last_ = {.T_a_b = T_map_robot, .covariance = share.inverse() * reckoned};
  GoOn(map_robot_, last_robot);
  GoOn(map_robot_of_next_, last_robot);
  if (map_robot_of_next_ && ++scans_of_next_ < kScans) return;
  map_robot_ = map_robot_of_next_;
  map_robot_of_next_ = map_last_;
  scans_before_ = std::exchange(scans_before_next_, scans);
  scans_of_next_ = 0;
}

void DeadReckoning::Clear() {
  map_robot_.reset();
  map_robot_of_next_.reset();
  scans_of_next_ = 0;
}

void DeadReckoning::Move(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  map_last_ = new_old * map_last_;
  MoveTo(map_robot_, new_old);
  MoveTo(map_robot_of_next_, new_old);
}

bool IsFarFrom(const UncertainPose2& expected, const UncertainPose2& found) {
  return SquaredMahalanobisDistance(expected, found) > kFarChi2;
}

}  // namespace qwsm
