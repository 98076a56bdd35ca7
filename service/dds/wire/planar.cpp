// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/dds/wire/planar.hpp"

#include <cmath>
#include <cstring>

#include "qwsm/geometry/quaternion.hpp"
#include "service/dds/wire/robot_names.hpp"

namespace qwsm::dds {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

// Indices of x, y and yaw among (x, y, z, roll, pitch, yaw).
constexpr int kPlanar[3] = {0, 1, 5};

}  // namespace

std::optional<Timestamp> FromWire(const wire::Time& time) {
  if (time.nanosec >= kNanosecondsPerSecond) return std::nullopt;
  return std::chrono::seconds(time.sec) + std::chrono::nanoseconds(time.nanosec);
}

wire::Time ToWire(Timestamp stamp) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(stamp);
  return {.sec = static_cast<std::int32_t>(seconds.count()),
          .nanosec = static_cast<std::uint32_t>((stamp - seconds).count())};
}

std::chrono::nanoseconds Nanoseconds(double duration_s) {
  constexpr double kDay_s = 86400.0;
  if (!(std::abs(duration_s) < kDay_s)) return {};
  return std::chrono::round<std::chrono::nanoseconds>(std::chrono::duration<double>(duration_s));
}

wire::Quaternion QuaternionOf(double theta_rad) {
  const Quaternion rotation = qwsm::QuaternionOf(theta_rad);
  return {rotation.x, rotation.y, rotation.z, rotation.w};
}

double YawOf(const wire::Quaternion& q) { return qwsm::YawOf(Quaternion{q.x, q.y, q.z, q.w}); }

double UprightnessOf(const wire::Quaternion& q) {
  return qwsm::UprightnessOf(Quaternion{q.x, q.y, q.z, q.w});
}

wire::Pose ToWire(const Pose2& pose) {
  return {.position = {pose.x_m, pose.y_m, 0.0}, .orientation = QuaternionOf(pose.theta_rad)};
}

Pose2 FromWire(const wire::Pose& pose) {
  return {pose.position.x, pose.position.y, YawOf(pose.orientation)};
}

wire::Pose2D ToWire2D(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }

Pose2 FromWire(const wire::Pose2D& pose) {
  return {pose.x, pose.y, std::isfinite(pose.theta) ? NormalizeAngle(pose.theta) : pose.theta};
}

void CopyCovariance(const Eigen::Matrix3d& of_x_y_theta, double (&of_six)[36]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) of_six[6 * kPlanar[i] + kPlanar[j]] = of_x_y_theta(i, j);
  }
}

Eigen::Matrix3d PlanarCovariance(const double (&of_six)[36]) {
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) covariance(i, j) = of_six[6 * kPlanar[i] + kPlanar[j]];
  }
  return covariance;
}

void CopyCovariance(const Eigen::Matrix3d& of_x_y_theta, double (&of_three)[9]) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(of_three, 3, 3) = of_x_y_theta;
}

Eigen::Matrix3d CovarianceOf(const double (&of_three)[9]) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(of_three, 3, 3);
}

std::string_view ObjectionTo(const wire::Header& header) {
  const std::size_t length = strnlen(header.frame_id, kMaxNameLength + 1);
  if (!FromWire(header.stamp)) return "its stamp is no time";
  if (length == 0) return "its frame_id is empty";
  if (length > kMaxNameLength) return "its frame_id is too long";
  return {};
}

wire::Header HeaderOf(Timestamp stamp, const std::string& frame) {
  return {.stamp = ToWire(stamp), .frame_id = Borrow(frame)};
}

}  // namespace qwsm::dds
