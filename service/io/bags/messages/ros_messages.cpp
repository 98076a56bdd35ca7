// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/bags/messages/ros_messages.hpp"

#include <chrono>
#include <cmath>

#include "qwsm/sensor/scan_limits.hpp"

namespace qwsm::io {
namespace {

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

Eigen::Vector3d TakeVector(MessageReader& fields) {
  Eigen::Vector3d vector;
  for (double& value : vector) value = fields.Double();
  return vector;
}

/// The covariance of what stands before it: it begins with -1 where that is not measured.
bool TakeIsMeasured(MessageReader& fields) {
  constexpr int kOthers = 8;
  const double first = fields.Double();
  for (int i = 0; i < kOthers; ++i) fields.Double();
  return first != -1.0;
}

Transform3 TakeTransform(MessageReader& fields) {
  Transform3 transform;
  transform.x_m = fields.Double();
  transform.y_m = fields.Double();
  transform.z_m = fields.Double();
  transform.rotation = TakeQuaternion(fields);
  return transform;
}

/// From the first beam to the last, as they are stated.
double SpanOf_rad(const LaserScanMessage& scan) {
  return static_cast<double>(scan.last_bearing_rad) - static_cast<double>(scan.first_bearing_rad);
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

float BearingStepOf(const LaserScanMessage& scan) {
  if (std::abs(scan.bearing_step_rad) >= kLeastBearingStep_rad || scan.ranges_m.size() < 2) {
    return scan.bearing_step_rad;
  }
  return static_cast<float>(SpanOf_rad(scan) / static_cast<double>(scan.ranges_m.size() - 1));
}

bool ContradictsItself(const LaserScanMessage& scan) {
  if (scan.ranges_m.size() < 2) return false;
  const double step_rad = static_cast<double>(BearingStepOf(scan));
  const double beams = static_cast<double>(scan.ranges_m.size()) - 0.5;  // The last, or one more.
  return !(std::abs(SpanOf_rad(scan) / step_rad - beams) < 1.5);
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
  MessageReader fields(bytes, encoding);
  const RosHeader header = TakeHeader(fields);
  ImuMessage imu{.frame = header.frame, .reading = {.stamp = header.stamp}};
  const Quaternion orientation = TakeQuaternion(fields);
  const bool is_orientation_known = TakeIsMeasured(fields);
  imu.reading.turn_rate_rad_s = TakeVector(fields);
  if (!TakeIsMeasured(fields)) throw MessageError("it says that it measures no turn rate");
  const Eigen::Vector3d acceleration_mps2 = TakeVector(fields);
  if (TakeIsMeasured(fields)) imu.reading.acceleration_mps2 = acceleration_mps2;
  const bool is_rotation = std::isfinite(UprightnessOf(orientation));
  if (is_orientation_known && is_rotation) imu.reading.orientation = orientation;
  const std::string_view objection = ObjectionTo(imu.reading);
  if (!objection.empty()) throw MessageError(std::string(objection));
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
