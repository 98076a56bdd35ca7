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

}  // namespace

std::optional<UncertainPose2> DeadReckoning::Predict(const UncertainPose2& last_robot) const {
  if (!way_) return std::nullopt;
  return way_->map_robot * last_robot;
}

void DeadReckoning::Follow(const UncertainPose2& last_robot,
                           const Pose2& T_map_robot,
                           const Eigen::Matrix3d& told,
                           std::size_t scans) {
  const Eigen::Matrix3d reckoned = (map_last_ * last_robot).covariance;
  const Eigen::Matrix3d share = Eigen::Matrix3d::Identity() + reckoned * told;
  map_last_ = {.T_a_b = T_map_robot, .covariance = share.inverse() * reckoned};
  for (std::optional<Way>* way : {&way_, &next_}) {
    if (*way) (*way)->map_robot = (*way)->map_robot * last_robot;
  }
  if (next_ && ++scans_of_next_ < kScans) return;
  way_ = std::exchange(next_, Way{.map_robot = map_last_, .scans_before = scans});
  scans_of_next_ = 0;
}

void DeadReckoning::Clear() {
  way_.reset();
  next_.reset();
  scans_of_next_ = 0;
}

void DeadReckoning::Move(const Pose2& T_new_old) {
  const UncertainPose2 new_old{.T_a_b = T_new_old};
  map_last_ = new_old * map_last_;
  for (std::optional<Way>* way : {&way_, &next_}) {
    if (*way) (*way)->map_robot = new_old * (*way)->map_robot;
  }
}

bool IsFarFrom(const UncertainPose2& expected, const UncertainPose2& found) {
  return SquaredMahalanobisDistance(expected, found) > kFarChi2;
}

}  // namespace qwsm
