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
/// @tparam Pose in the plane (Pose2), or in space (slam6d::Pose3).
template <class Pose = Pose2>
class OdometryBuffer {
 public:
  static constexpr std::size_t kCapacity = 1024;
  /// Longest gap between two readings in which poses are interpolated, and longest time after the
  /// last one for which it is carried on.
  static constexpr std::chrono::nanoseconds kMaxGap = std::chrono::milliseconds(500);
  static constexpr std::chrono::nanoseconds kMaxLead = std::chrono::milliseconds(100);

  /// Takes a reading, late ones too; readings before it are forgotten where the clock was set back.
  /// @return false if it is refused: not finite, known, or older than what is kept.
  bool Add(Timestamp stamp, const Pose& T_odom_robot);

  bool empty() const { return readings_.empty(); }
  /// Whether there is a reading of that time or later, so that waiting tells nothing new.
  bool Covers(Timestamp stamp) const;
  /// Whether the first reading is later, so that nothing will ever be known of that time.
  bool BeginsAfter(Timestamp stamp) const;
  /// How far a time is from the readings: later than all, or, as a negative number, earlier; 0
  /// among them, or where there are none.
  std::chrono::nanoseconds Apart(Timestamp stamp) const;
  /// The pose at a time: that of a reading if there is one of that time, else interpolated between
  /// its neighbours, or, shortly after the last one, carried on as the robot moved.
  std::optional<Pose> At(Timestamp stamp) const;

 private:
  struct Reading {
    Timestamp stamp{};
    Pose T_odom_robot;
  };

  bool Insert(const Reading& reading);

  StampGuard guard_;
  std::deque<Reading> readings_;  // Readings, by stamp.
};

extern template class OdometryBuffer<Pose2>;
extern template class OdometryBuffer<slam6d::Pose3>;

}  // namespace qwsm::team
