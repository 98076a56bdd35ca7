// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/messages/ros_messages.hpp"

#include <chrono>
#include <cmath>

#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

constexpr double kFastestTurn_rad_s = 100.0;
constexpr std::uint32_t kNanosecondsInSecond = 1'000'000'000;
// A transform is never shorter than its stamp, two lengths and seven numbers.
constexpr std::size_t kLeastTransformBytes = 72;

Timestamp TakeTime(MessageReader& fields) {
  const std::uint32_t seconds = fields.Unsigned32();
  const std::uint32_t nanoseconds = fields.Unsigned32();
  if (nanoseconds >= kNanosecondsInSecond) throw MessageError("its stamp is no time");
  // ROS 2 counts seconds with a sign, ROS 1 without.
  const std::int64_t whole = fields.encoding() == Encoding::kRos1
                                 ? std::int64_t{seconds}
                                 : std::int64_t{static_cast<std::int32_t>(seconds)};
  if (whole < 0) throw MessageError("its stamp is before 1970");
  return std::chrono::seconds(whole) + std::chrono::nanoseconds(nanoseconds);
}

Quaternion TakeQuaternion(MessageReader& fields) {
  Quaternion q;
  q.x = fields.Double();
  q.y = fields.Double();
  q.z = fields.Double();
  q.w = fields.Double();
  return q;
}

Transform3 TakeTransform(MessageReader& fields) {
  Transform3 transform;
  transform.x_m = fields.Double();
  transform.y_m = fields.Double();
  transform.z_m = fields.Double();
  transform.rotation = TakeQuaternion(fields);
  return transform;
}

}  // namespace

RosHeader TakeHeader(MessageReader& fields) {
  if (fields.encoding() == Encoding::kRos1) fields.Unsigned32();  // Sequence number.
  RosHeader header;
  header.stamp = TakeTime(fields);
  header.frame = fields.String();
  return header;
}

RosHeader DecodeHeader(std::string_view bytes, Encoding encoding) {
  MessageReader fields(bytes, encoding);
  return TakeHeader(fields);
}

LaserScanMessage DecodeLaserScan(std::string_view bytes, Encoding encoding) {
  MessageReader fields(bytes, encoding);
  LaserScanMessage scan;
  scan.header = TakeHeader(fields);
  scan.first_bearing_rad = fields.Float();
  scan.last_bearing_rad = fields.Float();
  scan.bearing_step_rad = fields.Float();
  scan.time_step_s = fields.Float();
  scan.scan_time_s = fields.Float();
  scan.range_min_m = fields.Float();
  scan.range_max_m = fields.Float();
  scan.ranges_m = fields.Floats(kMostBeams);
  return scan;  // Intensities are of no use here.
}

OdometryMessage DecodeOdometry(std::string_view bytes, Encoding encoding) {
  MessageReader fields(bytes, encoding);
  OdometryMessage message;
  message.header = TakeHeader(fields);
  message.child_frame = fields.String();
  message.T_frame_child = TakeTransform(fields);
  if (!IsSound(message.T_frame_child)) throw MessageError("its pose is no position");
  return message;
}

ImuMessage DecodeImu(std::string_view bytes, Encoding encoding) {
  constexpr int kOrientationAndItsCovariance = 4 + 9;
  MessageReader fields(bytes, encoding);
  ImuMessage imu;
  imu.header = TakeHeader(fields);
  for (int i = 0; i < kOrientationAndItsCovariance; ++i) fields.Double();
  for (double& rate_rad_s : imu.turn_rate_rad_s) {
    rate_rad_s = fields.Double();
    if (!(std::abs(rate_rad_s) <= kFastestTurn_rad_s)) throw MessageError("it turns at no rate");
  }
  return imu;
}

std::vector<TransformMessage> DecodeTransforms(std::string_view bytes, Encoding encoding) {
  MessageReader fields(bytes, encoding);
  std::vector<TransformMessage> transforms(fields.Count(kLeastTransformBytes));
  for (TransformMessage& transform : transforms) {
    transform.header = TakeHeader(fields);
    transform.child_frame = fields.String();
    transform.T_frame_child = TakeTransform(fields);
  }
  return transforms;
}

}  // namespace qwsm::io
