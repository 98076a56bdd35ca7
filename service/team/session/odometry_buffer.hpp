// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/team/session/stamp_guard.hpp"
#include "slam6d/geometry/pose3.hpp"

namespace qwsm::team {

/// The last odometry readings of a robot, to ask where it was when a scan was taken.
/// @tparam Pose in the plane, or in space: slam6d::Pose3.
template <class Pose = Pose2>
class OdometryBuffer {
 public:
  static constexpr std::size_t kCapacity = 1024;
  /// Between readings farther apart nothing is known; nor this long after the last one.
  static constexpr std::chrono::nanoseconds kMaxGap = std::chrono::milliseconds(500);
  static constexpr std::chrono::nanoseconds kMaxLead = std::chrono::milliseconds(100);

  /// Takes a reading, late ones too; all before it are forgotten where the clock was set back.
  /// @return false if it is refused: not finite, known, or older than what is kept.
  bool Add(Timestamp stamp, const Pose& T_odom_robot);

  bool empty() const { return readings_.empty(); }
  /// Whether there is a reading of that time or later: waiting tells nothing new.
  bool Covers(Timestamp stamp) const;
  /// Whether the first reading is later: nothing will ever be known of that time.
  bool BeginsAfter(Timestamp stamp) const;
  /// The reading at that time, exactly if there is one; else interpolated between its neighbours,
  /// or, shortly after the last one, carried on as the robot moved.
  std::optional<Pose> At(Timestamp stamp) const;

 private:
  struct Reading {
    Timestamp stamp{};
    Pose T_odom_robot;
  };

  bool Insert(const Reading& reading);

  StampGuard guard_;
  std::deque<Reading> readings_;  // By stamp.
};

extern template class OdometryBuffer<Pose2>;
extern template class OdometryBuffer<slam6d::Pose3>;

}  // namespace qwsm::team
