// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>
#include <optional>

#include "qwsm/sensor/imu_reading.hpp"

namespace qwsm {

/// How a robot leans.
struct Tilt {
  /// The direction against gravity in the robot's frame: (0, 0, 1) where it stands level.
  Eigen::Vector3d up_robot = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0.0;  ///< Of each of its two angles.
};

/// How a robot leans while it drives, by its inertial sensor, as against how it leans on average:
/// the floor is level on the whole, and no sensor is mounted to the tenth of a degree.
///
/// A Kalman filter of the direction against gravity. Turn rates move it, less their average, for
/// nobody leans further and further; what is felt of gravity, or the orientation the sensor works
/// out, draws it back. Accelerations of the drive are no gravity: how noisy that is, is learned,
/// and a reading far off counts the less. After a gap the filter begins anew with what is felt.
class TiltTrack {
 public:
  static constexpr std::size_t kUnlimited = 0;

  /// Keeps how the robot leant at the last so many readings, or at all.
  explicit TiltTrack(std::size_t capacity = kUnlimited) : capacity_(capacity) {}

  /// Forgets all: what comes next has another clock.
  void Restart() { *this = TiltTrack(capacity_); }
  /// Takes a reading about the robot's axes.
  /// @return false if it is refused: not later than the one before, or without gravity.
  bool Add(const ImuReading& reading);
  /// The tilt at a moment between two readings; nothing elsewhere, and in gaps.
  std::optional<Tilt> At(Timestamp stamp) const;

 private:
  struct Entry {
    Timestamp stamp{};
    Tilt tilt;
  };

  void Begin(const Eigen::Vector3d& felt);
  void Turn(const Eigen::Vector3d& turn_rate_rad_s, double duration_s);
  void Draw(const Eigen::Vector3d& felt);

  std::size_t capacity_;
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
  double variance_ = 0.0;
  double felt_variance_ = 0.0;
  Eigen::Vector3d up_on_average_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d rate_on_average_rad_s_ = Eigen::Vector3d::Zero();
  double readings_ = 0.0;
  std::deque<Entry> entries_;
};

}  // namespace qwsm
