// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "qwsm/sensor/imu_reading.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/io/bags/containers/message_source.hpp"
#include "service/io/bags/messages/message_reader.hpp"
#include "service/io/bags/messages/transform3.hpp"

/// The messages of ROS that matter here, as far as they do.
namespace qwsm::io {

inline constexpr std::string_view kLaserScanMessage = "sensor_msgs/LaserScan";
inline constexpr std::string_view kOdometryMessage = "nav_msgs/Odometry";
inline constexpr std::string_view kImuMessage = "sensor_msgs/Imu";
inline constexpr std::string_view kTransformsMessage = "tf2_msgs/TFMessage";
inline constexpr std::string_view kOldTransformsMessage = "tf/tfMessage";

struct RosHeader {
  Timestamp stamp{};
  std::string frame;
};

struct LaserScanMessage {
  RosHeader header;
  float first_bearing_rad = 0.0F;
  float last_bearing_rad = 0.0F;
  float bearing_step_rad = 0.0F;
  float time_step_s = 0.0F;  ///< Between beams.
  float scan_time_s = 0.0F;  ///< Between scans.
  float range_min_m = 0.0F;
  float range_max_m = 0.0F;
  std::vector<float> ranges_m;
};

/// The angle between beams: as it is stated, or, where that is none, by the first and last bearing.
float BearingStepOf(const LaserScanMessage& scan);
/// Whether the stated angle between beams ends elsewhere than at the stated last bearing, by more
/// than the beam that some writers count too many.
bool ContradictsItself(const LaserScanMessage& scan);

struct OdometryMessage {
  RosHeader header;
  std::string child_frame;
  Transform3 T_frame_child;
};

struct ImuMessage {
  std::string frame;
  ImuReading reading;  ///< About the axes of its frame.
};

struct TransformMessage {
  RosHeader header;
  std::string child_frame;
  Transform3 T_frame_child;
};

// All throw MessageError where the bytes are no such message.

/// Takes a header, the first field of a message. @throws MessageError.
RosHeader TakeHeader(MessageReader& fields);
/// The header, with which all these messages but transforms begin.
RosHeader DecodeHeader(std::string_view bytes, Encoding encoding);
LaserScanMessage DecodeLaserScan(std::string_view bytes, Encoding encoding);
OdometryMessage DecodeOdometry(std::string_view bytes, Encoding encoding);
ImuMessage DecodeImu(std::string_view bytes, Encoding encoding);
std::vector<TransformMessage> DecodeTransforms(std::string_view bytes, Encoding encoding);

}  // namespace qwsm::io
