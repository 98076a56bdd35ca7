// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "service/io/bags/messages/ros_messages.hpp"

namespace qwsm::io {

inline constexpr std::string_view kPointCloudMessage = "sensor_msgs/PointCloud2";

/// The points of a sensor_msgs/PointCloud2, in the sensor's frame.
struct PointCloudMessage {
  RosHeader header;
  /// x, y and z in metres. Points that are not finite are left out: drivers mark beams without an
  /// echo by them.
  std::vector<std::array<double, 3>> points_m;
};

/// Reads a cloud that has fields x, y and z, each FLOAT32 or FLOAT64, in any layout and of either
/// byte order. @throws MessageError where the bytes are none, or their layout reaches beyond them.
PointCloudMessage DecodePointCloud(std::string_view bytes, Encoding encoding);

}  // namespace qwsm::io
