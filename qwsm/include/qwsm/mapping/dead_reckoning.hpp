// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Where a robot would be by odometry alone since ten to twenty scans ago. Each match is near the
/// last one, as odometry has it, and may yet be a little behind every time: somebody who goes along
/// with the robot in a corridor keeps it where it is.
class DeadReckoning {
 public:
  /// @param last_robot motion since the last scan, as uncertain as odometry has proved to be.
  /// @return nothing for the first scans.
  std::optional<UncertainPose2> Predict(const UncertainPose2& last_robot) const;
  /// How many scans the map had when that began.
  std::size_t scans_before() const { return way_ ? way_->scans_before : 0; }

  /// Goes on after a scan.
  /// @param T_map_robot where the robot was found to be.
  /// @param told information of the scan about that, without what odometry tells; zero if it tells
  ///   nothing.
  /// @param scans of the map.
  void Follow(const UncertainPose2& last_robot,
              const Pose2& T_map_robot,
              const Eigen::Matrix3d& told,
              std::size_t scans);
  /// Begins anew where the robot is.
  void Clear();
  /// Follows a map that was moved here. @param T_new_old the old map's frame in the new one.
  void Move(const Pose2& T_new_old);

 private:
  // By odometry alone since a pose found.
  struct Way {
    UncertainPose2 map_robot;
    std::size_t scans_before = 0;  // That the map had when it began.
  };

  // Where the robot was found at the last scan, were odometry always as good as it has proved.
  UncertainPose2 map_last_;
  std::optional<Way> way_;
  std::optional<Way> next_;  // Began ten scans later.
  int scans_of_next_ = 0;
};

/// Whether a pose is as far from where it is expected as chance brings once in a million cases.
bool IsFarFrom(const UncertainPose2& expected, const UncertainPose2& found);

}  // namespace qwsm
