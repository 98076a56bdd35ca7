// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/tilt_track.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>

namespace qwsm {
namespace {

constexpr double kGyroNoise_rad_per_sqrt_s = 2e-3;  // Of an angle after a second: a cheap one.
constexpr double kReadingsWithoutBias = 100.0;      // That weigh as much as having none.
constexpr double kGravity_mps2 = 9.81;
constexpr double kFeltSigma_rad = 0.05;  // Of gravity, before that is learned.
constexpr double kLearningShare = 0.01;  // Share of the last reading in what is learned.
// A sensor that is silent for longer has missed how the robot leans, and turns.
constexpr std::chrono::nanoseconds kLongestWithoutTilt = std::chrono::milliseconds(200);

/// The third row of the rotation: what is up in a level frame, seen from the robot.
Eigen::Vector3d UpOf(const Quaternion& q) {
  return Eigen::Vector3d(2.0 * (q.x * q.z - q.y * q.w),
                         2.0 * (q.y * q.z + q.x * q.w),
                         q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z)
      .normalized();
}

/// Some drivers take gravity away; then only an orientation tells what is up.
std::optional<Eigen::Vector3d> FeltUp(const ImuReading& reading) {
  const bool has_gravity =
      reading.acceleration_mps2 && reading.acceleration_mps2->norm() > 0.5 * kGravity_mps2;
  if (has_gravity) return reading.acceleration_mps2->normalized();
  if (!reading.orientation) return std::nullopt;
  return UpOf(*reading.orientation);
}

}  // namespace

bool TiltTrack::Add(const ImuReading& reading) {
  const std::optional<Eigen::Vector3d> felt = FeltUp(reading);
  if (!felt) return false;
  if (entries_.empty()) {
    Begin(*felt);
  } else {
    const std::chrono::nanoseconds since = reading.stamp - entries_.back().stamp;
    if (since.count() <= 0) return false;
    if (since > kLongestWithoutTilt) {
      Begin(*felt);  // No robot turned at the last rate all the while.
    } else {
      Turn(reading.turn_rate_rad_s, Seconds(since));
      Draw(*felt);
    }
  }
  readings_ += 1.0;
  up_on_average_ += (up_ - up_on_average_) / readings_;
  const Eigen::Vector3d up_robot = up_ - up_on_average_ + Eigen::Vector3d::UnitZ();
  entries_.push_back(
      {.stamp = reading.stamp,
       .tilt = {.up_robot = up_robot.normalized(), .sigma_rad = std::sqrt(variance_)}});
  if (capacity_ != kUnlimited && entries_.size() > capacity_) entries_.pop_front();
  return true;
}

void TiltTrack::Begin(const Eigen::Vector3d& felt) {
  up_ = felt;
  felt_variance_ = kFeltSigma_rad * kFeltSigma_rad;
  variance_ = felt_variance_;
}

// What stands still in the world turns the other way in the robot's frame.
void TiltTrack::Turn(const Eigen::Vector3d& turn_rate_rad_s, double duration_s) {
  rate_on_average_rad_s_ +=
      (turn_rate_rad_s - rate_on_average_rad_s_) / (readings_ + kReadingsWithoutBias);
  Eigen::Vector3d rate_rad_s = turn_rate_rad_s;
  rate_rad_s.head<2>() -= rate_on_average_rad_s_.head<2>();
  up_ = (up_ - duration_s * rate_rad_s.cross(up_)).normalized();
  variance_ += kGyroNoise_rad_per_sqrt_s * kGyroNoise_rad_per_sqrt_s * duration_s;
}

void TiltTrack::Draw(const Eigen::Vector3d& felt) {
  const Eigen::Vector3d innovation = felt - up_;
  const double squared = 0.5 * innovation.squaredNorm();  // Of each of the two angles.
  const double gain = variance_ / (variance_ + felt_variance_ + squared);
  up_ = (up_ + gain * innovation).normalized();
  variance_ *= 1.0 - gain;
  felt_variance_ += kLearningShare * (squared - felt_variance_);
}

std::optional<Tilt> TiltTrack::At(Timestamp stamp) const {
  const auto after = std::ranges::lower_bound(entries_, stamp, {}, &Entry::stamp);
  if (after == entries_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->tilt;
  if (after == entries_.begin()) return std::nullopt;
  const Entry& before = *(after - 1);
  if (after->stamp - before.stamp > kLongestWithoutTilt) return std::nullopt;
  const double share = Seconds(stamp - before.stamp) / Seconds(after->stamp - before.stamp);
  const Eigen::Vector3d& up_before = before.tilt.up_robot;
  return Tilt{.up_robot = (up_before + share * (after->tilt.up_robot - up_before)).normalized(),
              .sigma_rad = std::max(before.tilt.sigma_rad, after->tilt.sigma_rad)};
}

}  // namespace qwsm
