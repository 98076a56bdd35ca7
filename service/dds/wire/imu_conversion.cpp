// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/imu_conversion.hpp"

#include <cmath>

#include "service/dds/wire/planar.hpp"

namespace qwsm::dds {
namespace {

// The first number of a covariance where there is nothing that it could be of.
constexpr double kNotMeasured = -1.0;

Eigen::Vector3d VectorOf(const wire::Vector3& v) { return {v.x, v.y, v.z}; }

wire::Vector3 ToWire(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

wire::Imu ToWire(const ImuReading& reading, const std::string& frame) {
  wire::Imu sample{};
  sample.header = HeaderOf(reading.stamp, frame);
  const Quaternion q = reading.orientation.value_or(Quaternion{});
  sample.orientation = {q.x, q.y, q.z, q.w};
  sample.angular_velocity = ToWire(reading.turn_rate_rad_s);
  sample.linear_acceleration = ToWire(reading.acceleration_mps2.value_or(Eigen::Vector3d::Zero()));
  if (!reading.orientation) sample.orientation_covariance[0] = kNotMeasured;
  if (!reading.acceleration_mps2) sample.linear_acceleration_covariance[0] = kNotMeasured;
  return sample;
}

std::string_view ObjectionTo(const wire::Imu& sample) {
  const std::string_view objection = ObjectionTo(sample.header);
  if (!objection.empty()) return objection;
  if (sample.angular_velocity_covariance[0] == kNotMeasured) {
    return "it says that it measures no turn rate";
  }
  return qwsm::ObjectionTo(FromWire(sample));
}

ImuReading FromWire(const wire::Imu& sample) {
  ImuReading reading{.stamp = *FromWire(sample.header.stamp),
                     .turn_rate_rad_s = VectorOf(sample.angular_velocity)};
  if (sample.linear_acceleration_covariance[0] != kNotMeasured) {
    reading.acceleration_mps2 = VectorOf(sample.linear_acceleration);
  }
  const bool is_rotation = std::isfinite(UprightnessOf(sample.orientation));
  if (sample.orientation_covariance[0] != kNotMeasured && is_rotation) {
    const wire::Quaternion& q = sample.orientation;
    reading.orientation = Quaternion{q.x, q.y, q.z, q.w};
  }
  return reading;
}

}  // namespace qwsm::dds
