// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/sensor/imu_reading.hpp"

#include <cmath>

namespace qwsm {
namespace {

constexpr double kFastestTurn_rad_s = 100.0;
constexpr double kMostAcceleration_mps2 = 1e4;

Eigen::Matrix3d MatrixOf(const Quaternion& q) {
  const double s = 2.0 / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  Eigen::Matrix3d R;
  R.row(0) << 1.0 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w),
      s * (q.x * q.z + q.y * q.w);
  R.row(1) << s * (q.x * q.y + q.z * q.w), 1.0 - s * (q.x * q.x + q.z * q.z),
      s * (q.y * q.z - q.x * q.w);
  R.row(2) << s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w),
      1.0 - s * (q.x * q.x + q.y * q.y);
  return R;
}

// In every component; one that is no number is not.
bool IsWithin(const Eigen::Vector3d& v, double most) { return (v.array().abs() <= most).all(); }

}  // namespace

ImuReading OnRobot(const ImuReading& reading, const Quaternion& robot_imu) {
  const Eigen::Matrix3d R_robot_imu = MatrixOf(robot_imu);
  const Quaternion imu_robot{-robot_imu.x, -robot_imu.y, -robot_imu.z, robot_imu.w};
  ImuReading on_robot{.stamp = reading.stamp,
                      .turn_rate_rad_s = R_robot_imu * reading.turn_rate_rad_s};
  if (reading.acceleration_mps2) {
    on_robot.acceleration_mps2 = R_robot_imu * *reading.acceleration_mps2;
  }
  if (reading.orientation) on_robot.orientation = *reading.orientation * imu_robot;
  return on_robot;
}

std::string_view ObjectionTo(const ImuReading& reading) {
  if (!IsWithin(reading.turn_rate_rad_s, kFastestTurn_rad_s)) return "it turns at no rate";
  if (reading.acceleration_mps2 && !IsWithin(*reading.acceleration_mps2, kMostAcceleration_mps2)) {
    return "its acceleration is none";
  }
  if (reading.orientation && !std::isfinite(UprightnessOf(*reading.orientation))) {
    return "its orientation is no rotation";
  }
  return {};
}

}  // namespace qwsm
